"""Verdicts as words in lists, each with a sign."""

from typing import Final

from tumble.calibrations.core.verdict import Outcome
from tumble.messages import translatable
from tumble.window.look.language import tr
from tumble.window.look.signs import CROSS, DASH, QUESTION, TICK

VERDICT_SIGNS: Final = {
    Outcome.PASS: TICK,
    Outcome.FAIL: CROSS,
    Outcome.NOT_DECIDED: QUESTION,
    Outcome.NO_LIMITS: DASH,
}
_WORDS: Final = {
    Outcome.PASS: translatable("inside"),
    Outcome.FAIL: translatable("outside"),
    Outcome.NOT_DECIDED: translatable("not decided"),
    Outcome.NO_LIMITS: translatable("not judged"),
}
_MARKS: Final = {
    Outcome.PASS: translatable("✓ inside"),
    Outcome.FAIL: translatable("✗ outside"),
    Outcome.NOT_DECIDED: translatable("? not decided"),
    Outcome.NO_LIMITS: translatable("not judged"),
}


def verdict_words(outcome: Outcome) -> str:
    """How a unit stands against the limits of its programme, where a sign is beside."""
    return tr(_WORDS[outcome])


def verdict_mark(outcome: Outcome) -> str:
    """The same where there is none."""
    return tr(_MARKS[outcome])
