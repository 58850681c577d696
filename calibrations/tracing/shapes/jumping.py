"""Waves that jump: a square wave, which switches to and fro, and a sawtooth wave, which resets.

Their overtones go on beyond the Nyquist limit of the values, where a sum of sines ends: such a wave is one column.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import product
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.gains import Gained
from tumble.calibrations.tracing.shapes.along import Along, Shape, named
from tumble.calibrations.tracing.shapes.waves import strongest_turns
from tumble.messages import Message

_Wave = Callable[[FloatArray, FloatArray], FloatArray]
_Turned = tuple[float, float]
"""Turns, and the part of one at which the wave begins."""
_PHASES: Final = 12
"""So many are tried of a wave."""
_FINER: Final = np.linspace(-0.5, 0.5, 9) / _PHASES
"""About the best of them."""


def square(part: FloatArray, turns_and_phase: FloatArray) -> FloatArray:
    """1 over the first half of each wave and -1 over the second, shape (rows, 1); the phase is a part of a wave."""
    return np.where(_in_the_wave(part, turns_and_phase) < 0.5, 1.0, -1.0)


def sawtooth(part: FloatArray, turns_and_phase: FloatArray) -> FloatArray:
    """From -1 to 1 over each wave, shape (rows, 1); the phase is a part of a wave."""
    return np.asarray(2.0 * _in_the_wave(part, turns_and_phase) - 1.0)


def _in_the_wave(part: FloatArray, turns_and_phase: FloatArray) -> FloatArray:
    turns, phase = turns_and_phase
    return np.asarray(np.mod(turns * part + phase, 1.0)[:, None])


_KINDS: Final = (("square", square), ("sawtooth", sawtooth))


def jumping_waves(along: Along) -> Iterator[Shape]:
    """The best square wave and the best sawtooth wave; of a circle, a whole number of them on it."""
    coordinate, turns = along.coordinate, strongest_turns(along)
    for word, wave in _KINDS if turns else ():
        (best, phase), _ = _of(along, wave, list(product(turns, np.arange(_PHASES) / _PHASES)))
        at, gained = _of(along, wave, [(best, phase + more) for more in _FINER])
        yield Shape(
            name=named(word, at),
            described=_said(word, coordinate.shown(float(coordinate.cycle / best))),
            columns=partial(wave, coordinate.part_of_cycle, np.array(at)),
            gained=gained,
            tried=coordinate.nyquist_turns * _PHASES,
        )


def _of(along: Along, wave: _Wave, tried: Sequence[_Turned]) -> tuple[_Turned, Gained]:
    """The best of waves of so many turns and such a phase, and what it gains."""
    columns = [wave(along.coordinate.part_of_cycle, np.array(each)) for each in tried]
    best, gained = along.best_single(np.column_stack(columns))
    return tried[best], gained


def _said(word: str, period: str) -> Message:
    if word == "square":
        return Message("in square waves of {period}", period=period)
    return Message("in sawtooth waves of {period}", period=period)
