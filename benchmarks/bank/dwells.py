"""Where and when the head dwells: a design is a word of letters, one for each block of a realisation.

Flips always come first. The clock: 60 s to seat the unit anew, 120 s of pause between realisations, 20 °/s of travel,
and 5 s to settle and to read.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.bank.geometry import AXES, FloatArray

SEAT_S, PAUSE_S, READ_S, SPEED_DEG_S = 60.0, 120.0, 5.0, 20.0
FIRST_MIDDLE_S: Final = SEAT_S + READ_S + 1.0 / SPEED_DEG_S
"""Middle of the first dwell: the head starts 1° below its angle, so the first move is a + move."""

_UP = np.arange(0.0, 400.0, 5.0)
Block = tuple[str, str, FloatArray]
"""Procedure, mount, angles in degrees."""
IntArray = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Dwells:
    """What a design fixes before anything is measured, one entry per row."""

    realisation: IntArray
    procedure: NDArray[np.str_]
    mount: NDArray[np.str_]
    angle_deg: FloatArray
    """Angle for which the head was sent."""
    time_s: FloatArray
    """Middle of the dwell."""
    direction: IntArray
    """Sign of the last move."""
    follows: NDArray[np.bool_]
    """True where the dwell came right after the one before: no change of mount, no pause."""
    mounting: IntArray
    """Number of the mounting, from 0."""
    axes: FloatArray
    """The unit's axes in the frame of the head, shape (rows, 3, 3)."""

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.angle_deg)

    @property
    def elapsed_s(self) -> FloatArray:
        """Seconds from the first row."""
        return np.asarray(self.time_s - self.time_s[0])


def _flips(_: np.random.Generator) -> list[Block]:
    return [
        ("flip", "face-up", np.array([-90.0, 90.0, 180.0, 0.0])),
        ("flip", "edge", np.array([180.0, 0.0])),
    ]


def _sweep(mount: str, angles_deg: FloatArray = _UP) -> Callable[[np.random.Generator], list[Block]]:
    return lambda _: [("sweep", mount, angles_deg)]


_BLOCKS: Final = MappingProxyType(
    {
        "f": _flips,
        "s": _sweep("face-up"),
        "b": _sweep("face-up", np.concatenate([_UP, _UP[::-1]])),
        "q": lambda rng: [("sweep", "face-up", rng.permutation(_UP))],
        "d": _sweep("face-down"),
        "r": _sweep("face-up-90"),
        "e": _sweep("edge"),
        "E": _sweep("edge-back"),
        "n": _sweep("end"),
    }
)
"""The letters, in the order in which a realisation runs through them. A `t` in a design is a temperature ramp."""


def dwells(design: str, realisations: int, rng: np.random.Generator) -> Dwells:
    """Lay out a design, for instance `bfdrt`. Only a shuffled design (`q`) draws from `rng`; the others are kept."""
    if unknown := set(design) - set(_BLOCKS) - {"t"}:
        raise ValueError(f"Design {design}: no block {''.join(sorted(unknown))}; known are {''.join(_BLOCKS)} and t.")
    return _laid_out(design, realisations, rng) if "q" in design else _fixed(design, realisations)


@lru_cache(maxsize=64)
def _fixed(design: str, realisations: int) -> Dwells:
    return _laid_out(design, realisations, np.random.default_rng(0))


def _laid_out(design: str, realisations: int, rng: np.random.Generator) -> Dwells:
    blocks = [
        (number, *block)
        for number in range(1, realisations + 1)
        for letter, make in _BLOCKS.items()
        if letter in design
        for block in make(rng)
    ]
    lengths = [len(angles) for *_, angles in blocks]
    realisation = np.repeat([block[0] for block in blocks], lengths)
    mount = np.repeat([block[2] for block in blocks], lengths)
    angle_deg = np.concatenate([angles for *_, angles in blocks])
    move_deg = np.diff(angle_deg, prepend=angle_deg[0] - 1.0)
    seated = np.concatenate([[False], mount[1:] != mount[:-1]])
    paused = np.diff(realisation, prepend=realisation[0]) > 0
    step_s = READ_S + np.abs(move_deg) / SPEED_DEG_S + SEAT_S * seated + PAUSE_S * paused
    follows = ~(seated | paused)
    follows[0] = False
    return Dwells(
        realisation=realisation.astype(np.int64),
        procedure=np.repeat([block[1] for block in blocks], lengths),
        mount=mount,
        angle_deg=angle_deg,
        time_s=FIRST_MIDDLE_S - step_s[0] + np.cumsum(step_s),
        direction=_held(np.sign(move_deg)).astype(np.int64),
        follows=follows,
        mounting=np.cumsum(seated),
        axes=np.stack([AXES[name] for name in mount]),
    )


def _held(sign: FloatArray) -> FloatArray:
    """Carry the last sign over rows without a move."""
    last = np.maximum.accumulate(np.where(sign != 0.0, np.arange(len(sign)), 0))
    return np.asarray(sign[last])
