"""Shapes along a variable that change at places: ramps, onsets that settle, levels that change several times.

A ramp is a slope between two places, or from one on; an onset is what begins at a place and settles to another level.
Levels are found one change after the other, the one that explains most beside the others first (orthogonal matching
pursuit, Pati, Rezaiifar and Krishnaprasad 1993).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import comb
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.coordinate import Coordinate, IntArray
from tumble.calibrations.tracing.gains import Beside, Gained, best_column, gains, gains_of_pairs

_PLACES: Final = 60
"""Places that are tried."""
_SETTLING: Final = (0.02, 0.05, 0.12, 0.3)
"""Times that an onset takes to settle, in ranges of the variable."""
_TIMES: Final = (0.7, 1.0, 1.4)
"""The same about the best of them."""
_MOST: Final = 12
"""Levels change so often at most."""
_DWELLS_EACH: Final = 12
"""So many dwells a level has at least, in the mean."""
_ROUNDS: Final = 2
"""So often each change is moved to where it fits best beside the others."""


@dataclass(frozen=True, kw_only=True)
class Change:
    """A shape that is fixed by places."""

    places: FloatArray
    """As parts of the range, in order; of an onset its place, and the time it takes to settle."""
    columns: Callable[[], FloatArray]
    """For a channel of one, shape (rows, n)."""
    gained: Gained
    tried: float = 1.0
    """How many of its kind are tried."""


class Changes:
    """All of them along a variable, for a channel beside what was found."""

    def __init__(self, coordinate: Coordinate, gain: FloatArray, seen: Beside) -> None:
        self._coordinate, self._seen = coordinate, seen
        self._level = gain * seen.root
        places = coordinate.places
        self._places = places[np.unique(np.linspace(0, len(places) - 1, _PLACES).round().astype(int))]

    def ramps(self) -> tuple[Change, Change]:
        """The best slope from a place on, and the best one between two places."""
        coarse = self._ramps(self._places)
        finer = np.unique(np.concatenate([self._coordinate.nearby(end) for each in coarse for end in each.places]))
        from_, between = self._ramps(finer)
        tried = len(self._places)
        return replace(from_, tried=tried), replace(between, tried=comb(tried, 2))

    def _ramps(self, places: FloatArray) -> tuple[Change, Change]:
        """The same among some places."""
        columns = np.maximum(self._coordinate.part[:, None] - places, 0.0) * self._level[:, None]
        whole, gram, along = self._products(columns)
        squares, rows = self._seen.squares, len(columns)
        best, gained = best_column(np.diag(gram), np.diag(whole), along**2, squares, rows)
        from_ = self._ramp(places[[best]], gained)
        first, last = np.triu_indices(len(places), 1)
        beyond = np.sum(self._coordinate.stepped(places), axis=0)
        left = _between(gram, first, last) * (beyond[first] - beyond[last] >= self._coordinate.fewest_rows)
        power = (along[first] - along[last]) ** 2
        best, gained = best_column(left, _between(whole, first, last), power, squares, rows)
        return from_, self._ramp(places[[first[best], last[best]]], gained)

    def _ramp(self, ends: FloatArray, gained: Gained) -> Change:
        return Change(places=ends, columns=lambda: ramp(self._coordinate.part, ends), gained=gained)

    def onset(self) -> Change:
        """The best one of all that begin at a place, jump, and settle to another level."""
        begun = np.array([(place, time) for time in _SETTLING for place in self._places.tolist()])
        best, _ = self._onset(begun)
        place, time = begun[best].tolist()
        nearby = self._coordinate.nearby(place)
        finer = np.array([(near, time * ratio) for ratio in _TIMES for near in nearby.tolist()])
        finest, gained = self._onset(finer)
        return Change(
            places=finer[finest],
            columns=lambda: onset(self._coordinate.part, finer[finest]),
            gained=gained,
            tried=len(begun),
        )

    def _onset(self, begun: FloatArray) -> tuple[int, Gained]:
        """Number and gain of the best of them, given as places and times, shape (onsets, 2)."""
        first, second = _begun(self._coordinate.part, begun)
        weighted, square = np.column_stack([self._seen.taken, self._seen.left]) * self._level[:, None], self._level**2
        sums = (weighted.T @ first, weighted.T @ second)
        products = (square @ first**2, square @ second**2, square @ (first * second))
        falls, variances = gains_of_pairs(self._seen.squares, len(square), sums, products)
        best = int(np.argmax(falls))
        return best, (float(falls[best]), float(variances[best]))

    def levels(self) -> Change:
        """Levels that change at the places, and as often, as explains most beyond what so many changes cost."""
        places = self._coordinate.places
        columns = self._coordinate.stepped(places) * self._level[:, None]
        whole, gram, along = self._products(columns)
        chosen = list[int]()
        told = list[tuple[float, tuple[int, ...], Gained]]()
        most = max(min(_MOST, len(self._level) // (_DWELLS_EACH * self._coordinate.outputs)), 1)
        for _ in range(min(most, len(places))):
            chosen.append(_next(gram, along, chosen))
            for _ in range(_ROUNDS):
                chosen = _moved(gram, along, chosen)
            gained = self._gained(gram, whole, along, chosen)
            told.append((gained[0] - 2.0 * np.log(comb(len(places), len(chosen))), tuple(sorted(chosen)), gained))
        _, best, _ = max(told)
        ends, gained = self._exact_levels(places[list(best)])
        tried = most * comb(len(places), len(ends))
        return Change(places=ends, columns=lambda: levels(self._coordinate.part, ends), gained=gained, tried=tried)

    def _exact_levels(self, coarse: FloatArray) -> tuple[FloatArray, Gained]:
        """Each change moved to where it fits best between two rows."""
        places = np.unique(np.concatenate([self._coordinate.nearby(float(place)) for place in coarse]))
        whole, gram, along = self._products(self._coordinate.stepped(places) * self._level[:, None])
        chosen = np.searchsorted(places, coarse).tolist()
        for _ in range(_ROUNDS):
            chosen = _moved(gram, along, chosen)
        return places[sorted(chosen)], self._gained(gram, whole, along, chosen)

    def _gained(self, gram: FloatArray, whole: FloatArray, along: FloatArray, chosen: list[int]) -> Gained:
        values, vectors = np.linalg.eigh(gram[np.ix_(chosen, chosen)])
        scale = float(np.sum(np.diag(whole)[chosen])) / len(self._level)
        power = (vectors.T @ along[chosen]) ** 2
        (fall,), (variance,) = gains(values[None] / scale, power[None] / scale, self._seen.squares, len(self._level))
        return float(fall), float(variance)

    def _products(self, columns: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Products of weighted columns with each other, of what is seen of them, and with what is left."""
        whole, taken = columns.T @ columns, self._seen.taken.T @ columns
        return whole, whole - taken.T @ taken, self._seen.left @ columns


def ramp(part: FloatArray, ends: FloatArray) -> FloatArray:
    """A slope from one end on, or between two, where rows are at a part of a range: shape (rows, 1)."""
    ramped = np.maximum(part[:, None] - ends, 0.0)
    return np.asarray(ramped[:, :1] - (ramped[:, 1:] if len(ends) > 1 else 0.0))


def onset(part: FloatArray, begun: FloatArray) -> FloatArray:
    """A jump at a place and what decays after it within a time, shape (rows, 2)."""
    return np.column_stack(_begun(part, begun[None]))


def levels(part: FloatArray, places: FloatArray) -> FloatArray:
    """A step at each of the places, shape (rows, places)."""
    return (part[:, None] > places).astype(float)


def _begun(part: FloatArray, begun: FloatArray) -> tuple[FloatArray, FloatArray]:
    """What has jumped, and what is left of what decays, shape (rows, onsets) each."""
    since = part[:, None] - begun[:, 0]
    jump = (since > 0.0).astype(float)
    return jump, jump * np.exp(-np.maximum(since, 0.0) / begun[:, 1])


_ALIKE: Final = 1e-6
"""What is left of a column beside the others, in parts of itself, is seen if it is more."""


def _next(gram: FloatArray, along: FloatArray, chosen: list[int]) -> int:
    """The column that explains most beside those that were chosen."""
    beside = gram[:, chosen]
    solved = np.linalg.lstsq(gram[np.ix_(chosen, chosen)], np.column_stack([beside.T, along[chosen]]), rcond=_ALIKE)[0]
    left = np.diag(gram) - np.sum(beside * solved[:, :-1].T, axis=1)
    told = along - beside @ solved[:, -1]
    seen = left > _ALIKE * np.diag(gram).max()
    return int(np.argmax(np.where(seen, told**2 / np.where(seen, left, 1.0), -1.0)))


def _moved(gram: FloatArray, along: FloatArray, chosen: list[int]) -> list[int]:
    """Each of the columns in turn where it explains most beside the others."""
    moved = list(chosen)
    for number in range(len(moved)):
        others = moved[:number] + moved[number + 1 :]
        moved[number] = _next(gram, along, others)
    return moved


def _between(gram: FloatArray, first: IntArray, last: IntArray) -> FloatArray:
    """Squares of the differences of columns, from their products."""
    length = np.diag(gram)
    return np.asarray(length[first] + length[last] - 2.0 * gram[first, last])
