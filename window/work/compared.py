"""Two records held against each other, as they are shown."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Interval:
    """A value and the ends of its 95% interval, all in one unit."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, kw_only=True)
class ComparedLine:
    """One parameter of two records."""

    name: str
    first: str
    second: str
    difference: str
    """The second minus the first, with its expanded uncertainty (95%); empty where there is none."""
    ratio: str
    """The difference in its standard uncertainties."""
    sentence: str
    """All of that in words."""
    conclusion: str
    """What the difference means, or why there is none."""
    intervals: tuple[Interval | None, Interval | None]
    """Of both, to be drawn on one axis; None where there is none, or where both are of different units."""


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """All parameters of two records."""

    first: str
    """Unit and moment."""
    second: str
    unlike: Sequence[str]
    """What else is not the same in both, a sentence each."""
    lines: Sequence[ComparedLine]
