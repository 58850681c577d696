"""Waves that are no sines: a period with its overtones, each smaller than the one before."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

_OVERTONES: Final = 8
"""The period itself and so many less one of its overtones, as far as the values show them."""
_PLACES_EACH: Final = 8
"""So many distinct values there are at least for a wave, and for each overtone."""
_FINER: Final = 5
"""So many turns more, and fewer, are tried about each."""


def periods(turns: Sequence[float], limit: float, places: int) -> list[FloatArray]:
    """Turns of the wave and of its overtones up to a limit, for each number of turns of the wave.

    There are fewer overtones where they would be as many as the distinct values of the variable, `places`.
    """
    most = min(_OVERTONES, places // _PLACES_EACH)
    return [
        turn * np.arange(1.0, min(most, int(limit / turn)) + 1.0) for turn in turns if 2.0 * turn <= limit and most > 1
    ]


def overtones(part: FloatArray, turns: FloatArray) -> FloatArray:
    """Sines and cosines of a wave and its overtones over the part of a range, shape (rows, 2n), smaller and smaller.

    `turns` are those of the wave, then whole multiples of them: each overtone turns once more with the wave.
    """
    wave = np.exp(2.0j * np.pi * turns[0] * part)
    turned = np.cumprod(np.broadcast_to(wave[:, None], (len(part), len(turns))), axis=1)
    return np.asarray(np.concatenate([turned.imag, turned.real], axis=1) * (turns[0] / np.tile(turns, 2)))


def candidates(falls: FloatArray, turns: FloatArray, limit: float) -> Iterator[float]:
    """Turns that the wave may have whose strongest part, or overtone, explains most by itself."""
    strongest, apart = float(turns[np.argmax(falls)]), float(turns[0])
    for order in (1, 2, 3):
        about = strongest / order
        for turn in about + np.linspace(-0.5, 0.5, 2 * _FINER + 1) * apart / order:
            if turn >= 1.0 and 2.0 * turn <= limit:
                yield float(turn)
