"""Kinds that depend on the head's angle, within a turn or over turns."""

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.unnamed.kind import Kind
from benchmarks.blind.unnamed.waves import bump, harmonics, saw, sine, square
from benchmarks.blind.world import World


def _around_deg(angle_deg: FloatArray, centre_deg: float) -> FloatArray:
    """Angle from a centre on the circle, -180° to 180°."""
    return np.mod(angle_deg - centre_deg + 180.0, 360.0) - 180.0


def square_wave_of_head(world: World, rng: np.random.Generator) -> FloatArray:
    """A toothed coupling that is on one flank or the other."""
    return square(world.run.angle_deg / 360.0 * int(rng.integers(3, 8)) + rng.uniform())


def saw_tooth_of_head(world: World, rng: np.random.Generator) -> FloatArray:
    """An interpolator that resets."""
    return saw(world.run.angle_deg / 360.0 * int(rng.integers(2, 6)) + rng.uniform())


def odd_harmonics_of_head(world: World, rng: np.random.Generator) -> FloatArray:
    """Two reading heads, one worse than the other: odd harmonics only."""
    return harmonics(world.run.angle_deg / 360.0, (3, 5, 7, 9), rng)


def sector_of_head(world: World, rng: np.random.Generator) -> FloatArray:
    """A scratch: the angle errs within a sector."""
    return bump(_around_deg(world.run.angle_deg, rng.uniform(0.0, 360.0)), 0.0, rng.uniform(25.0, 60.0))


def stretched_sector(world: World, rng: np.random.Generator) -> FloatArray:
    """A scale that was put on in two parts: a step at each joint, a slope between."""
    off_deg = _around_deg(world.run.angle_deg, rng.uniform(0.0, 360.0))
    return np.where(off_deg > 0.0, off_deg / 180.0 - 0.5, 0.2)


def jumps_of_head(world: World, rng: np.random.Generator) -> FloatArray:
    """A table of corrections, wrong by a level of its own in each of fifteen sectors."""
    levels = rng.normal(size=15)
    return np.asarray((levels - levels.mean())[(np.mod(world.run.angle_deg, 360.0) // 24.0).astype(int)])


def cable_of_head(world: World, rng: np.random.Generator) -> FloatArray:
    """A cable that touches: an offset of the output within a sector of the head."""
    off_deg = _around_deg(world.run.angle_deg, rng.uniform(0.0, 360.0))
    return np.maximum(1.0 - np.abs(off_deg) / rng.uniform(30.0, 70.0), 0.0)


def ripple_over_turns(world: World, rng: np.random.Generator) -> FloatArray:
    """A gear that comes round again after more or less than a turn."""
    return sine(world.run.angle_deg / rng.uniform(205.0, 300.0) + rng.uniform())


def winding_cable(world: World, rng: np.random.Generator) -> FloatArray:
    """A cable that pulls once it is wound up beyond a point."""
    angle_deg = world.run.angle_deg
    free_deg = np.ptp(angle_deg) * rng.uniform(0.35, 0.6)
    return np.asarray(np.maximum(angle_deg - angle_deg.min() - free_deg, 0.0) / 180.0)


KINDS = (
    Kind("angle", "angle", square_wave_of_head),
    Kind("angle", "angle", saw_tooth_of_head),
    Kind("angle", "angle", odd_harmonics_of_head),
    Kind("angle", "angle", sector_of_head),
    Kind("angle", "angle", stretched_sector),
    Kind("angle", "angle", jumps_of_head),
    Kind("offset", "angle", cable_of_head),
    Kind("angle", "unwrapped_angle", ripple_over_turns, ("turns",)),
    Kind("offset", "unwrapped_angle", winding_cable, ("turns",)),
)
