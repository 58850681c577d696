"""A slope from a place on, or between two."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import comb
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.gains import Gained, best_column
from tumble.calibrations.tracing.shapes.along import Along, Shape, beside, named
from tumble.calibrations.tracing.shapes.places import FEWEST_PLACES, squares_between
from tumble.messages import Message

_Best = Callable[[Along, FloatArray], tuple[FloatArray, Gained]]
"""The best slope with its ends at some of the places."""
_ENDS: Final = 100
"""Places at which the ends of a slope are tried."""
_ABOUT: Final = np.linspace(-0.5, 0.5, 9)
_CLOSER: Final = 2
"""So often the ends of a slope are tried anew, each time so much closer."""


def ramps(along: Along) -> Iterator[Shape]:
    """The best slope from a place on, and the best one between two places.

    Along what the declared model has a slope in, as the scale factor is one over the acceleration, a slope from a place
    on is the same rows as one up to it, with another scale factor. Of a slope between two moments either level may be
    that of rest.
    """
    if len(along.coordinate.places) < FEWEST_PLACES:
        return
    places = _ends(along)
    straight = along.undetermined(along.coordinate.part)
    for best in (_from, _between):
        at, gained = _finer(along, best, best(along, places)[0])
        apart = float(np.ptp(at)) if along.coordinate.onsets else 0.0
        rest = along.undetermined(np.full(along.rows, apart))
        yield Shape(
            name=named("ramp", at.tolist()),
            described=_said(*(along.shown(part) for part in at.tolist())),
            columns=partial(ramp, along.coordinate.part, at),
            whole=beside(np.column_stack([straight, rest]), partial(ramp, along.coordinate.part, at)),
            gained=gained,
            tried=comb(len(places), len(at)),
        )


def _finer(along: Along, best: _Best, ends: FloatArray) -> tuple[FloatArray, Gained]:
    """The best slope and what it gains, with its ends anywhere between two rows about those."""
    apart = np.array([np.ptp(along.coordinate.nearby(float(end))) for end in ends])
    for _ in range(_CLOSER):
        ends, gained = best(along, np.unique(np.clip(ends + np.outer(_ABOUT, apart), 0.0, 1.0)))
        apart *= _ABOUT[-1] - _ABOUT[-2]
    return ends, gained


def ramp(part: FloatArray, ends: FloatArray) -> FloatArray:
    """A slope from one end on, or between two, where rows are at a part of a range: shape (rows, 1)."""
    ramped = np.maximum(part[:, None] - ends, 0.0)
    return np.asarray(ramped[:, :1] - (ramped[:, 1:] if len(ends) > 1 else 0.0))


def _ends(along: Along) -> FloatArray:
    """Places where a slope may begin or end; where there are few values, between those too."""
    places = along.coordinate.places
    return np.asarray(np.interp(np.linspace(0.0, len(places) - 1.0, _ENDS), np.arange(len(places)), places))


def _from(along: Along, places: FloatArray) -> tuple[FloatArray, Gained]:
    """End and gain of the best slope from one of the places on."""
    sloped = _Sloped.at(along, places)
    several = np.sum(along.coordinate.stepped(places), axis=0) >= along.coordinate.fewest_rows
    left, whole = np.diag(sloped.gram) * several, np.diag(sloped.whole)
    best, gained = best_column(left, whole, sloped.with_left**2, along.seen.squares, along.rows)
    return places[[best]], gained


def _between(along: Along, places: FloatArray) -> tuple[FloatArray, Gained]:
    """Ends and gain of the best slope between two of them."""
    sloped = _Sloped.at(along, places)
    first, last = np.triu_indices(len(places), 1)
    beyond = np.sum(along.coordinate.stepped(places), axis=0)
    several = beyond[first] - beyond[last] >= along.coordinate.fewest_rows
    left, whole = (squares_between(each, first, last) for each in (sloped.gram, sloped.whole))
    power = (sloped.with_left[first] - sloped.with_left[last]) ** 2
    best, gained = best_column(left * several, whole, power, along.seen.squares, along.rows)
    return places[[first[best], last[best]]], gained


@dataclass(frozen=True, kw_only=True)
class _Sloped:
    """Slopes from places on, as products of their weighted columns."""

    whole: FloatArray
    """Products with each other, shape (places, places)."""
    gram: FloatArray
    """The same of what is seen of them."""
    with_left: FloatArray
    """Products with what is left of the output, shape (places,)."""

    @classmethod
    def at(cls, along: Along, places: FloatArray) -> "_Sloped":
        columns = np.maximum(along.coordinate.part[:, None] - places, 0.0) * along.level[:, None]
        taken, whole = along.seen.taken.T @ columns, columns.T @ columns
        return cls(whole=whole, gram=whole - taken.T @ taken, with_left=along.seen.left @ columns)


def _said(start: str, stop: str = "") -> Message:
    if stop:
        return Message("in a slope from {start} to {stop}", start=start, stop=stop)
    return Message("in a slope from {start} on", start=start)
