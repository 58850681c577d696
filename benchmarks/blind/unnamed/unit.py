"""Kinds that depend on gravity in the unit's axes, or on how long the unit has been in its seat."""

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.unnamed.kind import Kind
from benchmarks.blind.unnamed.waves import bump, lagged, saw, sine
from benchmarks.blind.world import World


def dead_band(world: World, rng: np.random.Generator) -> FloatArray:
    """A suspension that sticks around level: nothing moves there."""
    width = rng.uniform(0.12, 0.25)
    return np.asarray(-np.clip(world.ax, -width, width))


def soft_stop(world: World, rng: np.random.Generator) -> FloatArray:
    """A stop that is touched at one end."""
    return np.asarray(np.maximum(rng.choice([-1.0, 1.0]) * world.ax - rng.uniform(0.75, 0.9), 0.0))


def chirp_over_ax(world: World, rng: np.random.Generator) -> FloatArray:
    """Fringes that come closer: waves over ax whose period shrinks."""
    along = 1.0 + world.ax
    return sine(rng.uniform(0.3, 0.6) * along + rng.uniform(0.3, 0.5) * along**2 + rng.uniform())


def tooth_over_ay(world: World, rng: np.random.Generator) -> FloatArray:
    """A second axis that is digitised coarsely and fed in."""
    return saw(world.ay / rng.uniform(0.5, 0.9) + rng.uniform())


def bump_of_pose(world: World, rng: np.random.Generator) -> FloatArray:
    """A particle that shorts two plates in some poses: near a direction of gravity."""
    towards = rng.normal(size=3) * (1.0, 1.0, 0.2)
    off = np.degrees(np.arccos(np.clip(world.gravity @ (towards / np.linalg.norm(towards)), -1.0, 1.0)))
    return bump(off, 0.0, rng.uniform(50.0, 80.0))


def creep_after_seating(world: World, rng: np.random.Generator) -> FloatArray:
    """A seat that relaxes with two time constants."""
    since_s = world.run.since_seating_s
    quick, slow = np.exp(-since_s / rng.uniform(25.0, 50.0)), np.exp(-since_s / rng.uniform(120.0, 240.0))
    return np.asarray(0.6 * quick + 0.4 * slow)


def scale_after_seating(world: World, rng: np.random.Generator) -> FloatArray:
    """A scale factor that recovers after the unit was handled."""
    since_s = world.run.since_seating_s / rng.uniform(60.0, 200.0)
    return np.asarray(since_s * np.exp(1.0 - since_s))


def cross_term_after_seating(world: World, rng: np.random.Generator) -> FloatArray:
    """A cross term, ax ay, that fades with time since seating."""
    return world.ax * world.ay * np.exp(-world.run.since_seating_s / rng.uniform(60.0, 200.0))


def creep_of_pose_history(world: World, rng: np.random.Generator) -> FloatArray:
    """A spring that creeps: the output remembers the ax of the last minutes, less that of now."""
    return lagged(world.ax, world.run.time_s, rng.uniform(60.0, 300.0)) - world.ax


KINDS = (
    Kind("offset", "acceleration", dead_band),
    Kind("offset", "acceleration", soft_stop),
    Kind("offset", "acceleration", chirp_over_ax),
    Kind("offset", "acceleration", tooth_over_ay),
    Kind("offset", "pose", bump_of_pose),
    Kind("offset", "time_since_seating", creep_after_seating),
    Kind("scale", "time_since_seating", scale_after_seating),
    Kind("offset", "time_since_seating", cross_term_after_seating, also=("pose",)),
    Kind("offset", "time", creep_of_pose_history, also=("acceleration", "direction")),
)
