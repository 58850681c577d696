"""Waves of any phase, and waves with overtones."""

from collections.abc import Iterator
from functools import partial
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import BoolArray, FloatArray
from tumble.calibrations.tracing.shapes.along import Along, Shape, named, sides
from tumble.calibrations.tracing.shapes.overtones import candidates, overtones, periods
from tumble.messages import Message

_EACH_TURN: Final = 8
"""Parts of a turn by which waves with overtones are told apart."""
_STRONGEST: Final = 3
"""So many waves round a circle are tried in other shapes."""
_ABOUT: Final = 5
"""So many of about the best one, where turns are no whole number."""


def waves(along: Along) -> Iterator[Shape]:
    """The best wave of any phase, up to the Nyquist limit."""
    coordinate = along.coordinate
    if not len(coordinate.turns):
        return
    finer = coordinate.turns[np.argmax(along.falls_of_waves)] + np.linspace(-0.5, 0.5, 11) * coordinate.turns[0]
    swing = coordinate.swung(finer)
    best, gain = along.best_pair(swing)
    yield Shape(
        name=named("wave", [finer[best]]),
        described=Message("in waves of {period}", period=coordinate.shown(float(coordinate.range / finer[best]))),
        columns=partial(sides, swing, best),
        gained=gain,
        tried=len(coordinate.turns),
    )


def waves_with_overtones(along: Along) -> Iterator[Shape]:
    """The best wave with overtones: of a circle, a whole number of them on it."""
    coordinate, part = along.coordinate, along.coordinate.part_of_cycle
    limit, places = coordinate.nyquist_turns, len(np.unique(np.round(part, 6)))
    told = [(along.together(overtones(part, turns)), turns) for turns in periods(_turns(along), limit, places)]
    if not told:
        return
    best, turns = max(told, key=lambda each: each[0])
    shown = coordinate.shown(float(coordinate.cycle / turns[0]))
    yield Shape(
        name=named("period", [turns[0], len(turns)]),
        described=Message("in waves of {period} with overtones", period=shown),
        columns=partial(overtones, part, turns),
        gained=best,
        tried=int(limit) * (_EACH_TURN if coordinate.period is None else 1),
    )


def _turns(along: Along) -> list[float]:
    """Numbers of turns that are tried."""
    coordinate = along.coordinate
    if coordinate.period is not None:
        return [float(turns) for turns in range(1, int(coordinate.nyquist_turns / 2.0) + 1)]
    if not len(coordinate.turns):
        return []
    return list(candidates(along.falls_of_waves, coordinate.turns, coordinate.nyquist_turns))


def strongest_turns(along: Along) -> list[float]:
    """Numbers of turns of the waves that explain most as sines: of a circle whole ones, else about the highest peak.

    What a drift explains as waves falls from the slowest on, without a peak.
    """
    coordinate = along.coordinate
    if coordinate.period is None:
        if not len(coordinate.turns):
            return []
        within = (coordinate.turns >= 1.0) & (2.0 * coordinate.turns <= coordinate.nyquist_turns)
        best = coordinate.turns[np.argmax(np.where(within & _peaks(along.falls_of_waves), along.falls_of_waves, -1.0))]
        about = best + np.linspace(-0.5, 0.5, _ABOUT) * coordinate.turns[0]
        return [float(turns) for turns in about if turns >= 1.0 and 2.0 * turns <= coordinate.nyquist_turns]
    whole = np.arange(1.0, int(coordinate.nyquist_turns / 2.0) + 1.0)
    if not len(whole):
        return []
    phase = 2.0 * np.pi * np.outer(coordinate.part_of_cycle, whole)
    falls, _ = along.pairs((np.sin(phase), np.cos(phase)))
    return [float(turns) for turns in whole[np.argsort(-falls)[:_STRONGEST]]]


def _peaks(falls: FloatArray) -> BoolArray:
    """Where values are no less than those beside them; the first is none, nor is the last."""
    inside = (falls[1:-1] >= falls[:-2]) & (falls[1:-1] >= falls[2:])
    return np.concatenate([[False], inside, [False]])[: len(falls)]
