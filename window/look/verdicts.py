"""Verdicts as words in lists, each with a sign."""

from typing import Final

from tumble.calibrations.core.verdict import Outcome
from tumble.window.look.language import tr
from tumble.window.look.signs import CROSS, DASH, QUESTION, TICK

VERDICT_SIGNS: Final = {
    Outcome.PASS: TICK,
    Outcome.FAIL: CROSS,
    Outcome.NOT_DECIDED: QUESTION,
    Outcome.NO_LIMITS: DASH,
}

_MARKS: Final = {Outcome.PASS: "✓ ", Outcome.FAIL: "✗ ", Outcome.NOT_DECIDED: "? ", Outcome.NO_LIMITS: ""}


def verdict_words(outcome: Outcome) -> str:
    """How a unit stands against the limits of its programme, where a sign is beside."""
    match outcome:
        case Outcome.PASS:
            return tr("inside")
        case Outcome.FAIL:
            return tr("outside")
        case Outcome.NOT_DECIDED:
            return tr("not decided")
        case Outcome.NO_LIMITS:
            return tr("not judged")


def verdict_mark(outcome: Outcome) -> str:
    """The same where there is none."""
    return f"{_MARKS[outcome]}{verdict_words(outcome)}"
