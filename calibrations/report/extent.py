"""Where the axes of a panel begin and end, and the round numbers along them."""

import math
from collections.abc import Iterator, Sequence
from typing import Final, TypeAlias

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import fixed
from tumble.calibrations.report.layers import Area, Axis, Boxes, Cells, Line, Marks, Panel, Shades, Span

Ends: TypeAlias = tuple[float, float]
_MARGIN: Final = 0.05
"""Of what is drawn, left free on both sides of it."""


def extent(panel: Panel) -> tuple[Ends, Ends]:
    """Ends of both axes of a panel."""
    return (
        panel.x.ends or _around([each for layer in panel.layers for each in _reach(layer, 0)], panel.x),
        panel.y.ends or _around([each for layer in panel.layers for each in _reach(layer, 1)], panel.y),
    )


def ticks(axis: Axis, ends: Ends, most: int) -> list[float]:
    """Places of the numbers along an axis, `most` of them or fewer."""
    low, high = sorted(ends)
    if len(axis.ticks):
        return [float(tick) for tick in axis.ticks if low - 1e-9 <= tick <= high + 1e-9]
    if axis.logarithmic and len(places := _decades(low, high)) > 1:
        return places
    step = round_step((high - low) / (2 * most if axis.whole else most))
    if axis.whole:
        step = max(1.0, math.ceil(step))
    first = math.ceil(low / step - 1e-9)
    return [number * step for number in range(first, math.floor(high / step + 1e-9) + 1)]


def tick_texts(axis: Axis, places: Sequence[float]) -> list[str]:
    """What stands at these places."""
    if axis.names:
        known = dict(zip(map(float, axis.ticks), axis.names, strict=True))
        return [known[place] for place in places]
    if axis.logarithmic or len(places) < 2:
        return [f"{place:g}" for place in places]
    digits = max(0, *(_places(place) for place in (*places, places[1] - places[0])))
    return [f"{place:g}" if abs(place) >= 1e6 else fixed(place, digits) for place in places]


def round_step(least: float) -> float:
    """The smallest of 1, 2, 5 times a power of ten that is no less."""
    if not least > 0 or not math.isfinite(least):
        return 1.0
    power = 10.0 ** math.floor(math.log10(least) + 1e-12)
    return next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= least * (1 - 1e-9))


def _places(number: float) -> int:
    return next(
        (places for places in range(9) if math.isclose(round(number, places), number, rel_tol=1e-9, abs_tol=1e-12)), 9
    )


def _decades(low: float, high: float) -> list[float]:
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    steps = (1.0,) if last - first >= 2 else (1.0, 2.0, 5.0)
    places = [step * 10.0**power for power in range(first - 1, last + 1) for step in steps]
    return [place for place in places if low * (1 - 1e-9) <= place <= high * (1 + 1e-9)]


def _around(columns: Sequence[FloatArray], axis: Axis) -> Ends:
    """Ends a little outside of all numbers."""
    numbers = np.concatenate([np.zeros(0), *(np.asarray(column, dtype=float) for column in columns)])
    known = numbers[np.isfinite(numbers) & ((numbers > 0.0) | (not axis.logarithmic))]
    if not len(known):
        return (1.0, 10.0) if axis.logarithmic else (0.0, 1.0)
    low, high = float(known.min()), float(known.max())
    if axis.logarithmic:
        room = max((high / low) ** _MARGIN, 1.05)
        return low / room, high * room
    room = _MARGIN * (high - low) or 0.5 * abs(high) or 1.0
    return low - room, high + room


def _reach(layer: object, axis: int) -> Iterator[FloatArray]:
    """The numbers that a layer needs room for, along x (0) or y (1)."""
    match layer:
        case Marks():
            yield (layer.x, layer.y)[axis]
            yield from (layer.x_ends, layer.y_ends)[axis] or ()
        case Line() | Shades():
            yield (layer.x, layer.y)[axis]
        case Area():
            yield from ((layer.x,), (layer.low, layer.high))[axis]
        case Span():
            yield np.array(() if axis == 0 else (layer.low, layer.high))
        case Boxes():
            yield np.array([-0.5, len(layer.groups) - 0.5]) if axis == 0 else np.concatenate(layer.groups)
        case Cells():
            yield np.array([-0.5, layer.values.shape[1 - axis] - 0.5])
