"""A slope from a place on, or between two; and what begins at a place, jumps, and settles to another level."""

from collections.abc import Iterator
from functools import partial
from math import comb
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.gains import Gained, best_column
from tumble.calibrations.tracing.shapes.along import Along, Shape, beside, named
from tumble.calibrations.tracing.shapes.places import FEWEST_PLACES, squares_between
from tumble.messages import Message

_PLACES: Final = 60
"""Places that are tried."""
_SETTLING: Final = (0.02, 0.05, 0.12, 0.3)
"""Times that an onset takes to settle, in ranges of the variable."""
_TIMES: Final = (0.7, 1.0, 1.4)
"""The same about the best of them."""


def ramps(along: Along) -> Iterator[Shape]:
    """The best slope from a place on, and the best one between two places.

    Along what the declared model has a slope in, as the scale factor is one over the acceleration, a slope from a place
    on is the same rows as one up to it, with another scale factor.
    """
    if len(along.coordinate.places) < FEWEST_PLACES:
        return
    places = _tried(along)
    ends = [ends for ends, _ in _ramps(along, places)]
    finer = np.unique(np.concatenate([along.coordinate.nearby(float(end)) for each in ends for end in each]))
    straight = along.undetermined(along.coordinate.part)
    for at, gained in _ramps(along, finer):
        yield Shape(
            name=named("ramp", at.tolist()),
            described=_said(*(along.shown(part) for part in at.tolist())),
            columns=partial(ramp, along.coordinate.part, at),
            whole=beside(straight, partial(ramp, along.coordinate.part, at)),
            gained=gained,
            tried=comb(len(places), len(at)),
        )


def onsets(along: Along) -> Iterator[Shape]:
    """The best of all that begin at a place, jump, and settle to another level."""
    if len(along.coordinate.places) < FEWEST_PLACES:
        return
    tried = np.array([(place, time) for time in _SETTLING for place in _tried(along).tolist()])
    place, time = tried[_onset(along, tried)[0]].tolist()
    near = along.coordinate.nearby(place).tolist()
    finer = np.array([(other, time * ratio) for ratio in _TIMES for other in near])
    best, gained = _onset(along, finer)
    settling = along.coordinate.shown(float(along.coordinate.range * finer[best, 1]))
    start = along.shown(float(finer[best, 0]))
    yield Shape(
        name=named("onset", finer[best].tolist()),
        described=Message("from {start} on, settling within {time}", start=start, time=settling),
        columns=partial(onset, along.coordinate.part, finer[best]),
        gained=gained,
        tried=len(tried),
    )


def ramp(part: FloatArray, ends: FloatArray) -> FloatArray:
    """A slope from one end on, or between two, where rows are at a part of a range: shape (rows, 1)."""
    ramped = np.maximum(part[:, None] - ends, 0.0)
    return np.asarray(ramped[:, :1] - (ramped[:, 1:] if len(ends) > 1 else 0.0))


def onset(part: FloatArray, begun: FloatArray) -> FloatArray:
    """A jump at a place and what decays after it within a time, shape (rows, 2)."""
    return np.column_stack(_begun(part, begun[None]))


def _tried(along: Along) -> FloatArray:
    places = along.coordinate.places
    return np.asarray(places[np.unique(np.linspace(0, len(places) - 1, _PLACES).round().astype(int))])


def _ramps(along: Along, places: FloatArray) -> tuple[tuple[FloatArray, Gained], tuple[FloatArray, Gained]]:
    """Ends and gain of the best slope from one of the places on, and of the best between two."""
    columns = np.maximum(along.coordinate.part[:, None] - places, 0.0) * along.level[:, None]
    taken, with_left, whole = along.seen.taken.T @ columns, along.seen.left @ columns, columns.T @ columns
    gram, squares = whole - taken.T @ taken, along.seen.squares
    one, gain_of_one = best_column(np.diag(gram), np.diag(whole), with_left**2, squares, along.rows)
    first, last = np.triu_indices(len(places), 1)
    beyond = np.sum(along.coordinate.stepped(places), axis=0)
    left = squares_between(gram, first, last) * (beyond[first] - beyond[last] >= along.coordinate.fewest_rows)
    power = (with_left[first] - with_left[last]) ** 2
    two, gain_of_two = best_column(left, squares_between(whole, first, last), power, squares, along.rows)
    return (places[[one]], gain_of_one), (places[[first[two], last[two]]], gain_of_two)


def _onset(along: Along, begun: FloatArray) -> tuple[int, Gained]:
    """Number and gain of the best of them, given as places and times, shape (onsets, 2)."""
    return along.best_pair(_begun(along.coordinate.part, begun))


def _begun(part: FloatArray, begun: FloatArray) -> tuple[FloatArray, FloatArray]:
    """What has jumped, and what is left of what decays, shape (rows, onsets) each."""
    since = part[:, None] - begun[:, 0]
    jump = (since > 0.0).astype(float)
    return jump, jump * np.exp(-np.maximum(since, 0.0) / begun[:, 1])


def _said(start: str, stop: str = "") -> Message:
    if stop:
        return Message("in a slope from {start} to {stop}", start=start, stop=stop)
    return Message("in a slope from {start} on", start=start)
