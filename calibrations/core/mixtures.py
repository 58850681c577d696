"""Intervals of a quantity of which it is not known which of several distributions is its own."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Part:
    """One distribution of a mixture: Student's, its lower half and its upper half each with a width of its own."""

    odds: float
    """Against the other parts; they need not add up to 1."""
    value: float
    low: float
    """Lower end of its own 95% interval."""
    high: float


def interval_95(parts: Sequence[Part], degrees_of_freedom: float) -> tuple[float, float]:
    """Where a mixture has 2.5% below, and above."""
    low, high = min(part.low for part in parts), max(part.high for part in parts)
    return _crossing(parts, degrees_of_freedom, low, high, 0.025), _crossing(
        parts, degrees_of_freedom, low, high, 0.975
    )


def _crossing(parts: Sequence[Part], degrees_of_freedom: float, low: float, high: float, chance: float) -> float:
    """Where the distribution function reaches a chance, by halving what holds it."""
    for _ in range(50):
        middle = (low + high) / 2.0
        if _below(parts, degrees_of_freedom, middle) < chance:
            low = middle
        else:
            high = middle
    return (low + high) / 2.0


def _below(parts: Sequence[Part], degrees_of_freedom: float, at: float) -> float:
    from scipy.special import stdtr, stdtrit  # takes a tenth of a second, in which a window is half up

    freedom = min(degrees_of_freedom, 1e9)
    factor = float(stdtrit(freedom, 0.975))
    odds = np.array([part.odds for part in parts])
    off = np.array([_off(part, at) for part in parts])
    return float(odds @ stdtr(freedom, factor * off) / odds.sum())


def _off(part: Part, at: float) -> float:
    """How far a place is from the value of a part, in half widths of its interval."""
    width = part.high - part.value if at > part.value else part.value - part.low
    return (at - part.value) / max(width, 1e-300)
