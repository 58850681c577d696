"""What begins at a place: it jumps and settles to another level, or rises and is gone again."""

from collections.abc import Iterator
from functools import partial
from itertools import combinations
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.shapes.along import Along, Shape, named
from tumble.calibrations.tracing.shapes.places import FEWEST_PLACES
from tumble.messages import Message

_Pair = tuple[FloatArray, FloatArray]
_PLACES: Final = 60
"""Places that are tried."""
_SETTLING: Final = (0.02, 0.05, 0.12, 0.3)
"""Times that an onset takes to settle, in ranges of the variable; two of them are those of a transient."""
_TIMES: Final = (0.7, 1.0, 1.4)
"""The same about the best of them."""


def onsets(along: Along) -> Iterator[Shape]:
    """The best of all that begin at a place, jump, and settle to another level."""
    if len(along.coordinate.places) < FEWEST_PLACES:
        return
    tried = np.array([(place, time) for time in _SETTLING for place in _tried(along).tolist()])
    place, time = tried[along.best_pair(_settling(along.coordinate.part, tried))[0]].tolist()
    near = along.coordinate.nearby(place).tolist()
    finer = np.array([(other, time * ratio) for ratio in _TIMES for other in near])
    best, gained = along.best_pair(_settling(along.coordinate.part, finer))
    settling = along.coordinate.shown(float(along.coordinate.range * finer[best, 1]))
    start = along.shown(float(finer[best, 0]))
    yield Shape(
        name=named("onset", finer[best].tolist()),
        described=Message("from {start} on, settling within {time}", start=start, time=settling),
        columns=partial(onset, along.coordinate.part, finer[best]),
        gained=gained,
        tried=len(tried),
    )


def transients(along: Along) -> Iterator[Shape]:
    """The best of all that begin at a place, rise at once or within a time, and are gone within a longer one."""
    if len(along.coordinate.places) < FEWEST_PLACES:
        return
    pairs = list(combinations((0.0, *_SETTLING), 2))
    tried = np.array([(place, *times) for times in pairs for place in _tried(along).tolist()])
    place, quick, slow = tried[along.best_single(transient(along.coordinate.part, tried))[0]].tolist()
    near = along.coordinate.nearby(place).tolist()
    about = [(quick * one, slow * other) for one in (_TIMES if quick else (1.0,)) for other in _TIMES]
    finer = np.array([(other, *times) for times in about for other in near])
    best, gained = along.best_single(transient(along.coordinate.part, finer))
    yield Shape(
        name=named("transient", finer[best].tolist()),
        described=_passing(along, *finer[best].tolist()),
        columns=partial(transient, along.coordinate.part, finer[best][None]),
        gained=gained,
        tried=len(tried),
    )


def _passing(along: Along, place: float, quick: float, slow: float) -> Message:
    start, gone = along.shown(place), along.coordinate.shown(along.coordinate.range * slow)
    if quick == 0.0:
        return Message("from {start} on, gone within {gone}", start=start, gone=gone)
    rising = along.coordinate.shown(along.coordinate.range * quick)
    return Message("from {start} on, rising within {time} and gone within {gone}", start=start, time=rising, gone=gone)


def onset(part: FloatArray, begun: FloatArray) -> FloatArray:
    """A jump at a place and what decays after it within a time, shape (rows, 2)."""
    return np.column_stack(_settling(part, begun[None]))


def transient(part: FloatArray, begun: FloatArray) -> FloatArray:
    """What begins at places, rises within a time, and decays within another, shape (rows, transients).

    `begun` are places and both times, a row each; a time of 0 is a jump.
    """
    single, number = np.unique(begun[:, [0, 1, 0, 2]].reshape(-1, 2), axis=0, return_inverse=True)
    left = _left(part[:, None] - single[:, 0], single[:, 1])
    quick, slow = number.reshape(-1, 2).T
    return np.asarray(left[:, slow] - left[:, quick])


def _tried(along: Along) -> FloatArray:
    places = along.coordinate.places
    return np.asarray(places[np.unique(np.linspace(0, len(places) - 1, _PLACES).round().astype(int))])


def _settling(part: FloatArray, begun: FloatArray) -> _Pair:
    """What has jumped, and what is left of what decays, shape (rows, onsets) each."""
    since = part[:, None] - begun[:, 0]
    return (since > 0.0).astype(float), _left(since, begun[:, 1])


def _left(since: FloatArray, time: FloatArray) -> FloatArray:
    """What is left of what was one at first, within times; of a time of 0 nothing."""
    slow = np.where(time > 0.0, time, 1.0)
    return np.asarray((since > 0.0) * (time > 0.0) * np.exp(-np.maximum(since, 0.0) / slow))
