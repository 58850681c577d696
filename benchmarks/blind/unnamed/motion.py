"""Kinds that depend on how the head moved, on the repeat, or on the place in the order."""

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.unnamed.kind import Kind
from benchmarks.blind.unnamed.waves import bump, saw
from benchmarks.blind.world import World


def _since_reversal_deg(world: World) -> FloatArray:
    """Way of the head since it last turned back."""
    run = world.run
    way_deg = np.cumsum(np.abs(np.diff(run.angle_deg, prepend=run.angle_deg[0])))
    turned = np.r_[True, run.direction[1:] != run.direction[:-1]]
    return np.asarray(way_deg - np.maximum.accumulate(np.where(turned, way_deg, 0.0)))


def stick_slip(world: World, rng: np.random.Generator) -> FloatArray:
    """A bearing that sticks and slips: a saw-tooth of the way since the last reversal, against the motion."""
    return np.asarray(world.run.direction * (1.0 + saw(_since_reversal_deg(world) / rng.uniform(60.0, 150.0))))


def scale_by_direction(world: World, rng: np.random.Generator) -> FloatArray:
    """A scale factor that differs between the ways of turning."""
    return np.where(world.run.direction < 0, rng.choice([-1.0, 1.0]), 0.0)


def backlash_in_a_sector(world: World, rng: np.random.Generator) -> FloatArray:
    """A worn part of a gear: play after moves in - direction, within a sector."""
    off_deg = np.mod(world.run.angle_deg - rng.uniform(0.0, 360.0) + 180.0, 360.0) - 180.0
    return np.where(world.run.direction < 0, bump(off_deg, 0.0, rng.uniform(50.0, 90.0)), 0.0)


def scale_by_realisation(world: World, rng: np.random.Generator) -> FloatArray:
    """A scale factor that comes up anew at each start; its mean over realisations belongs to kx."""
    return world.run.centred(rng.normal(size=world.run.realisation.max())[world.run.realisation - 1])


def first_dwells_of_order(world: World, rng: np.random.Generator) -> FloatArray:
    """A meter that needs some readings after each start of a realisation."""
    return np.asarray(1.0 / (1.0 + world.run.place / rng.uniform(2.0, 10.0)))


def waves_of_order(world: World, rng: np.random.Generator) -> FloatArray:
    """A scanner that goes through its channels with the count of readings."""
    return saw(world.run.place / rng.uniform(13.0, 40.0))


KINDS = (
    Kind("angle", "direction", stick_slip, ("mounts", "turns", "shuffled"), ("unwrapped_angle",)),
    Kind("scale", "direction", scale_by_direction, ("mounts", "turns", "shuffled")),
    Kind("angle", "direction", backlash_in_a_sector, ("mounts", "turns", "shuffled"), ("angle",)),
    Kind("scale", "realisation", scale_by_realisation, ("mounts", "all_mounts", "shuffled")),
    Kind("offset", "order", first_dwells_of_order),
    Kind("offset", "order", waves_of_order),
)
