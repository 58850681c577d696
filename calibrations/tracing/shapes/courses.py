"""Courses: processes over the values of a variable, polynomials, and what wanders and is pulled back to its mean."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import COURSES
from tumble.calibrations.tracing.coordinate import IntArray
from tumble.calibrations.tracing.gains import gain_of_process
from tumble.calibrations.tracing.penalties import WALKS
from tumble.calibrations.tracing.shapes.along import Along, Shape, named, sides
from tumble.calibrations.tracing.shapes.wandering import PULLED_BACK, wandering
from tumble.messages import Message


def courses(along: Along) -> Iterator[Shape]:
    """Gaussian processes of every length."""
    coordinate, bins = along.coordinate, along.coordinate.bins
    order = np.argsort(bins, kind="stable")
    sums = np.add.reduceat(along.weighted[order], np.flatnonzero(np.diff(bins[order], prepend=-1)), axis=0)
    power = np.bincount(bins, along.level**2)
    gram, with_output = np.diag(power) - sums[:, :-1] @ sums[:, :-1].T, sums[:, -1]
    for name, root in coordinate.courses:
        scale = float(power @ np.sum(root**2, axis=1)) / along.rows
        with_root = (with_output @ root) / np.sqrt(scale)
        yield Shape(
            name=name,
            described=COURSES[name.split()[0]],
            columns=partial(_of_rows, root, bins),
            gained=gain_of_process(root.T @ gram @ root / scale, with_root, along.seen.squares, along.rows),
            tried=len(coordinate.courses),
        )


def bends(along: Along) -> Iterator[Shape]:
    """The best polynomial of low order."""
    tried = along.coordinate.bends
    best, gain = along.best_single(tried)
    yield Shape(
        name=f"bend {best}",
        described=Message("in a bend"),
        columns=partial(sides, [tried], best),
        whole=lambda: along.coordinate.polynomials,
        gained=gain,
        tried=tried.shape[1],
    )


def pulled_back(along: Along) -> Iterator[Shape]:
    """Processes that are pulled back to their mean, with more places than a course has.

    Where one is expected, it has the chance of a random walk.
    """
    for length in PULLED_BACK:
        columns = partial(wandering, along.coordinate.part, length)
        yield Shape(
            name=named("wandering", [length]),
            described=COURSES["wandering"],
            columns=columns,
            gained=along.together(columns()),
            tried=len(PULLED_BACK),
            chance=WALKS if along.axis.expected else None,
        )


def _of_rows(bins: FloatArray, number: IntArray) -> FloatArray:
    """What rows have of the values of bins."""
    return np.asarray(bins[number])
