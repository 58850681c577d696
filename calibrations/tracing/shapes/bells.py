"""Bumps at one place of a variable, and spots in space."""

from collections.abc import Iterator
from functools import partial

from tumble.calibrations.tracing.shapes.along import Along, Shape, named, sides
from tumble.messages import Message


def bumps(along: Along) -> Iterator[Shape]:
    """The best bump, with its slope, so that it may stand between two of the places."""
    coordinate, tried = along.coordinate, along.coordinate.bumps_tried
    if not len(tried):
        return
    coarse, _ = along.best_pair(coordinate.bells_tried)
    finer = coordinate.bumps_near(*tried[coarse].tolist())
    bells = coordinate.bells(finer)
    best, gain = along.best_pair(bells)
    place, width = (coordinate.shown(value) for value in finer[best].tolist())
    yield Shape(
        name=named("bump", finer[best].tolist()),
        described=Message("near {place}, within some {width}", place=place, width=width),
        columns=partial(sides, bells, best),
        gained=gain,
        tried=len(tried),
    )


def spots(along: Along) -> Iterator[Shape]:
    """The best spot in space."""
    coordinate, tried = along.coordinate, along.coordinate.spots_tried
    if not len(tried):
        return
    best, gain = along.best_single(coordinate.spots(tried))
    place = ", ".join(coordinate.shown(value) for value in tried[best, :-1].tolist())
    width = coordinate.shown(float(tried[best, -1]))
    yield Shape(
        name=named("spot", tried[best].tolist()),
        described=Message("near {place}, within some {width}", place=place, width=width),
        columns=partial(coordinate.spots, tried[[best]]),
        gained=gain,
        tried=len(tried),
    )
