"""Names of mounts and of effects as words for the operator, in the language of the window.

The words of the contracts (`face-down`, `scale_drift`) stay what they are in programmes, tables and documents.
"""

from typing import Final

from tumble.messages import Message, translatable, translate, with_wording
from tumble.window.look.language import spoken

_OTHER_EFFECTS: Final = {
    "head_scale": translatable("scale of the head"),
    "reference_drift": translatable("drift of the reference"),
    "reference_temperature": translatable("temperature sensitivity of the reference"),
    "temperature_linear": translatable("linear temperature dependence"),
    "temperature_quadratic": translatable("quadratic temperature dependence"),
    "temperature_cubic": translatable("cubic temperature dependence"),
    "temperature_quartic": translatable("quartic temperature dependence"),
    "temperature_break": translatable("break in the temperature dependence"),
    "temperature_step": translatable("step in the temperature dependence"),
    "temperature_hysteresis": translatable("temperature hysteresis"),
    "run_drift": translatable("drift from run to run"),
}
"""Effects that carry no name of their own."""


def mount_name(mount: str) -> str:
    """A mount as an operator reads it."""
    return _named(mount)


def effect_name(effect: str) -> str:
    """An effect as an operator reads it; one of the user's own keeps the word that its author gave it."""
    return _named(effect)


def has_name(word: str) -> bool:
    """Whether a word is one of a contract that has a name."""
    return word in _OTHER_EFFECTS or isinstance(with_wording(word), Message)


def _named(word: str) -> str:
    known = with_wording(_OTHER_EFFECTS.get(word, word))
    return known.worded(spoken()) if isinstance(known, Message) else translate(known, spoken())
