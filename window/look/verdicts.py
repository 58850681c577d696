"""Verdicts as words in lists, each with a sign."""

from tumble.calibrations.core.verdict import Outcome
from tumble.window.look.language import tr


def verdict_mark(outcome: Outcome) -> str:
    """How a unit stands against the limits of its programme."""
    return {
        Outcome.PASS: tr("✓ inside"),
        Outcome.FAIL: tr("✗ outside"),
        Outcome.NOT_DECIDED: tr("? not decided"),
        Outcome.NO_LIMITS: tr("not judged"),
    }[outcome]
