"""Sets a design's angles one after another, in time: moves, dwells, changes of mount, and the room around them."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.blind.designs import DESIGNS, Part
from benchmarks.blind.geometry import FloatArray, IntArray
from benchmarks.blind.run import Run

SPEED_DEG_S: Final = 18.0
SETTLE_S: Final = 3.0
DWELL_S: Final = 1.0
MOUNTING_S: Final = 75.0
NOISE_V: Final = 1e-4
"""Standard deviation of a dwell's mean where nothing disturbs it."""
SAMPLES: Final = 100
SHUFFLES: Final = frozenset({"shuffled"})
"""Designs that draw every realisation anew; the others repeat the first."""


def drawn_run(design: str, realisations: int, fresh: int, rng: np.random.Generator) -> Run:
    """Draw a run of `realisations` that the table holds and of `fresh` ones after them."""
    total = realisations + fresh
    draw = DESIGNS[design]
    parts = [draw(rng) for _ in range(total)] if design in SHUFFLES else [draw(rng)] * total
    angle_deg = np.concatenate([part.angles_deg for one in parts for part in one])
    mount = _spread([part.mount for one in parts for part in one], parts)
    realisation = np.repeat(np.arange(1, total + 1), [sum(len(part.angles_deg) for part in one) for one in parts])
    time_s, direction = _timed(angle_deg, mount)
    return Run(
        angle_deg=angle_deg,
        time_s=time_s,
        realisation=realisation,
        procedure=_spread([part.procedure for one in parts for part in one], parts),
        mount=mount,
        direction=direction,
        temperature_degc=_temperature_degc(time_s, rng),
        noise_v=np.full(len(time_s), NOISE_V),
        voltage_sd_v=np.full(len(time_s), NOISE_V * np.sqrt(SAMPLES)),
        fresh=realisation > realisations,
    )


def _spread(words: list[str], parts: list[list[Part]]) -> NDArray[np.str_]:
    return np.repeat(np.array(words), [len(part.angles_deg) for one in parts for part in one])


def _timed(angle_deg: FloatArray, mount: NDArray[np.str_]) -> tuple[FloatArray, IntArray]:
    """Return the middle of each dwell from the first, and the sign of the move before it."""
    move_deg = np.diff(angle_deg, prepend=angle_deg[0] - 1.0)
    mounting_s = np.where(np.r_[False, mount[1:] != mount[:-1]], MOUNTING_S, 0.0)
    time_s = np.cumsum(np.abs(move_deg) / SPEED_DEG_S + SETTLE_S + DWELL_S + mounting_s)
    direction = np.sign(move_deg).astype(np.int64)
    for row in np.flatnonzero(direction == 0):  # the head stood still: its last move counts
        direction[row] = direction[row - 1]
    return time_s - time_s[0], direction


def _temperature_degc(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    """A room: a trend, a slow swing, and a heater that comes and goes."""
    trend, swing, heater = rng.uniform(-0.6, 0.6), rng.uniform(0.4, 1.2), rng.uniform(0.2, 0.6)
    hours, phase = time_s / 3600.0, rng.uniform(0.0, 2.0 * np.pi, 2)
    slow = swing * np.sin(2.0 * np.pi * hours / rng.uniform(1.3, 2.6) + phase[0])
    quick = heater * np.sin(2.0 * np.pi * hours / rng.uniform(0.3, 0.7) + phase[1])
    return np.asarray(23.0 + rng.uniform(-0.8, 0.8) + trend * hours + slow + quick)
