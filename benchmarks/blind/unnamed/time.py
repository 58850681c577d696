"""Kinds that depend on time or temperature."""

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.unnamed.kind import Kind
from benchmarks.blind.unnamed.waves import harmonics, lagged, saw, sine
from benchmarks.blind.world import World


def saw_tooth_in_time(world: World, rng: np.random.Generator) -> FloatArray:
    """A supply that is topped up now and then."""
    return saw(world.run.time_s / (world.run.span_s * rng.uniform(0.06, 0.3)) + rng.uniform())


def chirp_in_time(world: World, rng: np.random.Generator) -> FloatArray:
    """A beat between two clocks that drift apart."""
    part = world.run.time_s / world.run.span_s
    return sine(rng.uniform(1.0, 3.0) * part + rng.uniform(4.0, 9.0) * part**2 + rng.uniform())


def odd_harmonics_in_time(world: World, rng: np.random.Generator) -> FloatArray:
    """An air conditioner that switches: odd harmonics of its period."""
    return harmonics(world.run.time_s / (world.run.span_s * rng.uniform(0.2, 0.5)), (1, 3, 5), rng)


def delayed_transient(world: World, rng: np.random.Generator) -> FloatArray:
    """Heat that arrives late and leaves with another time constant."""
    span_s = world.run.span_s
    since_s = np.maximum(world.run.time_s - span_s * rng.uniform(0.2, 0.5), 0.0)
    quick_s, slow_s = span_s * rng.uniform(0.02, 0.05), span_s * rng.uniform(0.1, 0.2)
    return np.asarray(np.exp(-since_s / slow_s) - np.exp(-since_s / quick_s))


def decaying_step(world: World, rng: np.random.Generator) -> FloatArray:
    """A knock in the middle of the run, which heals."""
    span_s = world.run.span_s
    since_s = world.run.time_s - span_s * rng.uniform(0.2, 0.6)
    return np.where(since_s >= 0.0, np.exp(-np.maximum(since_s, 0.0) / (span_s * rng.uniform(0.05, 0.2))), 0.0)


def telegraph(world: World, rng: np.random.Generator) -> FloatArray:
    """A contact that jumps between two states."""
    run = world.run
    jumps_s = np.cumsum(rng.exponential(run.span_s / 10.0, 60))
    return np.where(np.searchsorted(jumps_s, run.time_s) % 2 == 0, 1.0, -1.0)


def reverting_walk(world: World, rng: np.random.Generator) -> FloatArray:
    """A walk that is pulled back: a Gauss-Markov process; its mean over the rows is taken out (result.md)."""
    run = world.run
    keep = np.exp(-np.diff(run.time_s, prepend=0.0) / (run.span_s * rng.uniform(0.03, 0.1)))
    course = np.empty(len(keep))
    level = 0.0
    for row, (kept, kick) in enumerate(zip(keep, rng.normal(size=len(keep)), strict=True)):
        level = course[row] = kept * level + np.sqrt(1.0 - kept**2) * kick
    return run.centred(course)


def mains_beat(world: World, rng: np.random.Generator) -> FloatArray:
    """Mains that beat with the dwell: a period of a minute or two."""
    return sine(world.run.time_s / rng.uniform(60.0, 140.0) + rng.uniform())


def beat_on_scale(world: World, rng: np.random.Generator) -> FloatArray:
    """A reference voltage that is modulated."""
    return sine(world.run.time_s / rng.uniform(150.0, 600.0) + rng.uniform())


def rocking_base(world: World, rng: np.random.Generator) -> FloatArray:
    """A base that leans to and fro: the sun, a tide, a lift."""
    return sine(world.run.time_s / (world.run.span_s * rng.uniform(0.1, 0.35)) + rng.uniform())


def scale_lags_temperature(world: World, rng: np.random.Generator) -> FloatArray:
    """A scale factor that follows the temperature of a part inside."""
    run = world.run
    return run.centred(lagged(run.temperature_degc, run.time_s, rng.uniform(300.0, 1200.0)))


def ripple_over_temperature(world: World, rng: np.random.Generator) -> FloatArray:
    """A compensation by a table of few points: it errs in waves."""
    return sine(world.run.temperature_degc / rng.uniform(0.5, 0.9) + rng.uniform())


def knee_of_scale_in_temperature(world: World, rng: np.random.Generator) -> FloatArray:
    """A part that touches above a temperature: no effect below it."""
    degc = world.run.temperature_degc
    return np.maximum(degc - np.quantile(degc, rng.uniform(0.5, 0.8)), 0.0)


KINDS = (
    Kind("offset", "time", saw_tooth_in_time),
    Kind("offset", "time", chirp_in_time),
    Kind("offset", "time", odd_harmonics_in_time),
    Kind("offset", "time", delayed_transient),
    Kind("offset", "time", decaying_step),
    Kind("offset", "time", telegraph),
    Kind("offset", "time", reverting_walk),
    Kind("offset", "time", mains_beat),
    Kind("scale", "time", beat_on_scale),
    Kind("angle", "time", rocking_base),
    Kind("scale", "temperature", scale_lags_temperature),
    Kind("offset", "temperature", ripple_over_temperature),
    Kind("scale", "temperature", knee_of_scale_in_temperature),
)
