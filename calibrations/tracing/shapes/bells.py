"""Bumps at one place of a variable, and spots in space."""

from collections.abc import Iterator
from functools import partial
from typing import Final

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.shapes.along import Along, Shape, named, sides
from tumble.messages import Message

BUMP: Final = "bump"
_CLOSER: Final = 3
"""So often the best spot is moved to where it fits better, which may be where no row is."""


def bumps(along: Along) -> Iterator[Shape]:
    """The best bump, with its slope, so that it may stand between two of the places."""
    coordinate, tried = along.coordinate, along.coordinate.bumps_tried
    if not len(tried):
        return
    coarse, _ = along.best_pair(coordinate.bells_tried)
    yield _best(along, coordinate.bumps_near(*tried[coarse].tolist()))


def _best(along: Along, finer: FloatArray) -> Shape:
    """The best of some bumps, shape (bumps, 2)."""
    coordinate = along.coordinate
    bells = coordinate.bells(finer)
    best, gain = along.best_pair(bells)
    place, width = (coordinate.shown(value) for value in finer[best].tolist())
    return Shape(
        name=named(BUMP, finer[best].tolist()),
        described=Message("near {place}, within some {width}", place=place, width=width),
        columns=partial(sides, bells, best),
        gained=gain,
        tried=len(coordinate.bumps_tried),
    )


def bumps_about(along: Along) -> Iterator[Shape]:
    """The best bump of each width, and those beside it: a few places tell neither its width nor its centre."""
    coordinate = along.coordinate
    for width in coordinate.widths.tolist():
        if len(tried := coordinate.bumps_of(width)):
            coarse, _ = along.best_pair(coordinate.bells(tried))
            for each in coordinate.bumps_beside(*tried[coarse].tolist()):
                yield _best(along, each[None])


def spots(along: Along) -> Iterator[Shape]:
    """The best spot in space."""
    coordinate, tried = along.coordinate, along.coordinate.spots_tried
    if not len(tried):
        return
    best, gain = along.best_single(coordinate.spots(tried))
    spot = tried[best]
    for _ in range(_CLOSER):
        near = coordinate.spots_near(spot)
        best, gain = along.best_single(coordinate.spots(near))
        spot = near[best]
    place = ", ".join(coordinate.shown(value) for value in spot[:-1].tolist())
    width = coordinate.shown(float(spot[-1]))
    yield Shape(
        name=named("spot", spot.tolist()),
        described=Message("near {place}, within some {width}", place=place, width=width),
        columns=partial(coordinate.spots, spot[None]),
        gained=gain,
        tried=len(tried) * len(near),
    )
