"""A step at a place of a variable, and a pulse between two."""

from collections.abc import Iterator
from functools import partial
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.gains import Gained, best_column
from tumble.calibrations.tracing.shapes.along import Along, Shape, named, sides
from tumble.calibrations.tracing.shapes.places import FEWEST_PLACES, squares_between
from tumble.messages import Message

_Placed = tuple[Gained, tuple[int, ...]]
"""What is gained, and numbers of places."""
_KINDS: Final = (("step", 1), ("pulse", 2))


def steps(along: Along) -> Iterator[Shape]:
    """The best step at any place, and the best pulse between any two."""
    coordinate, places = along.coordinate, along.coordinate.places
    if len(places) < FEWEST_PLACES:
        return
    square = along.level**2
    coarse = _steps(along, places)
    for number, (word, ends_of_it) in enumerate(_KINDS):
        _, ends = coarse[number]
        finer = np.unique(np.concatenate([coordinate.nearby(float(places[end])) for end in ends]))
        gained, ends = _steps(along, finer)[number]
        between = coordinate.between(finer[list(ends)])
        if not (shown := float(square @ between)) > 0.0:
            continue  # the channel adds nothing there
        at, column = coordinate.on_the_shorter_arc(finer[list(ends)], between)
        yield Shape(
            name=named(word, at.tolist()),
            described=_said(*(along.shown(part) for part in at.tolist())),
            columns=partial(sides, [column[:, None]], 0),
            gained=(gained[0], gained[1] * float(square @ column) / shown),
            tried=len(places) ** ends_of_it // ends_of_it,
        )


def _steps(along: Along, places: FloatArray) -> tuple[_Placed, _Placed]:
    """The best step, and the best pulse: gain and variance, and the numbers of the places."""
    seen, coordinate = along.seen, along.coordinate
    sums = coordinate.sums_after(places, np.column_stack([along.weighted, along.level**2]))
    taken, with_left, length = sums[:, :-2], sums[:, -2], sums[:, -1]
    number, (first, last) = np.arange(len(places)), np.triu_indices(len(places), 1)
    whole = length[np.maximum.outer(number, number)]
    gram = whole - taken @ taken.T
    single = best_column(np.diag(gram), length, with_left**2, seen.squares, along.rows)
    before = coordinate.rows_before(places)
    long = before[last] - before[first] >= coordinate.fewest_rows
    lengths = (squares_between(gram, first, last) * long, squares_between(whole, first, last))
    double = best_column(*lengths, (with_left[first] - with_left[last]) ** 2, seen.squares, along.rows)
    return (single[1], (single[0],)), (double[1], (int(first[double[0]]), int(last[double[0]])))


def _said(start: str, stop: str = "") -> Message:
    if stop:
        return Message("from {start} to {stop}", start=start, stop=stop)
    return Message("in a step at {start}", start=start)
