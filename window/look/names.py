"""Names of effects and instruments as words for the operator, in the language of the window.

The words of the contracts (`scale_drift`) stay what they are in programmes, tables and documents.
"""

from typing import Final

from tumble.drivers.tables import CHAMBER, DAQ, EXCITER, HEAD, MOUNT
from tumble.drivers.text import visible
from tumble.messages import Message, with_wording
from tumble.window.look.language import spoken, tr
from tumble.window.look.shades import Shade

AIR: Final = "air_degc"
"""The channel by which the temperature of an environment is shown."""
_SHORT: Final = 32
"""Characters, the most that a name has among others."""


def instrument_name(name: str) -> str:
    """An instrument or a condition as an operator reads it: those that are usual in words, others by their names."""
    usual = {
        HEAD: tr("Dividing head"),
        DAQ: tr("Voltmeter"),
        CHAMBER: tr("Temperature chamber"),
        EXCITER: tr("Exciter"),
        MOUNT: tr("Mount"),
        "outer": tr("Outer axis"),
        "inner": tr("Inner axis"),
    }
    return usual.get(name, name)


def short_name(name: str) -> str:
    """A name that a person gave, where others want room beside it: of a long one the middle gives way."""
    return visible(name, _SHORT)


def effect_name(effect: str) -> str:
    """An effect as an operator reads it; one of the user's own keeps the word that its author gave it."""
    return in_words(effect)


def in_words(word: str) -> str:
    """A word of a contract in the words that it was declared with; any other as it is."""
    known = with_wording(word)
    return known.worded(spoken()) if isinstance(known, Message) else known


def shade_name(shade: Shade) -> str:
    """Colours of the window as an operator reads them."""
    return {
        Shade.DESKTOP: tr("As the desktop"),
        Shade.LIGHT: tr("Light"),
        Shade.DARK: tr("Dark"),
        Shade.CONTRAST: tr("High contrast"),
    }[shade]
