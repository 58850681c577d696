"""Effects of the unit: what is added to its output, per volt (or V/g, V/K, …) of the coefficient."""

from collections.abc import Callable
from types import MappingProxyType
from typing import Final

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.hysteresis import drawn_hysteresis
from benchmarks.bank.scene import Effect, OutputEffect, Run, Scene
from benchmarks.bank.surroundings import REFERENCE_DEGC

Draw = Callable[[np.random.Generator, Run], Effect]
HOUR_S = 3600.0


def either_sign(rng: np.random.Generator) -> float:
    """Draw +1 or -1."""
    return 1.0 if rng.uniform() < 0.5 else -1.0


def _proportional(name: str, form: Callable[[Scene], FloatArray]) -> Draw:
    """An effect that is its coefficient times `form`."""
    return lambda rng, _: OutputEffect(
        name=name, sign=either_sign(rng), added_v=lambda scene, amplitude: amplitude * form(scene)
    )


def _product(name: str, *axes: int) -> Draw:
    """A product of projections: axes 0, 2 is ax az."""
    return _proportional(name, lambda scene: np.asarray(np.prod(scene.gravity[:, list(axes)], axis=1)))


def _warmth(scene: Scene) -> FloatArray:
    return scene.run.temperature_degc - REFERENCE_DEGC


def _hours(scene: Scene) -> FloatArray:
    return scene.run.dwells.elapsed_s / HOUR_S


def _drawn_asymmetry(rng: np.random.Generator, _: Run) -> Effect:
    """A kink at zero input: sharp, or rounded over a few hundredths of g."""
    width = 0.0 if rng.uniform() < 0.5 else float(rng.uniform(0.01, 0.05))
    return OutputEffect(
        name="scale_asymmetry",
        shape="rounded" if width else "sharp",
        sign=either_sign(rng),
        added_v=lambda scene, amplitude: amplitude * (np.hypot(scene.gravity[:, 0], width) - width),
    )


def _drawn_warm_up(rng: np.random.Generator, run: Run) -> Effect:
    """Settling after switch-on: one time constant, two close ones, or stretched (Kohlrausch)."""
    tau_s = float(rng.uniform(0.04, 0.25) * run.dwells.elapsed_s[-1])
    x = run.dwells.elapsed_s / tau_s
    shape, decay = (
        ("exponential", np.exp(-x)),
        ("two time constants", 0.6 * np.exp(-x / 0.8) + 0.4 * np.exp(-x / 1.4)),
        ("stretched", np.exp(-(x**0.85))),
    )[rng.integers(3)]
    return OutputEffect(
        name="warm_up",
        shape=shape,
        sign=either_sign(rng),
        amplitude_key="amplitude",
        others={"tau_s": tau_s},
        added_v=lambda _, amplitude: amplitude * decay,
    )


def _drawn_wandering(rng: np.random.Generator, run: Run) -> Effect:
    """A Wiener process, or an Ornstein-Uhlenbeck process that is slow against the run; its mean over the rows is 0."""
    hours = run.dwells.elapsed_s / HOUR_S
    steps = rng.normal(size=len(hours))
    if rng.uniform() < 0.5:
        shape, path = "Wiener", np.cumsum(steps * np.sqrt(np.diff(hours, prepend=hours[0])))
    else:
        # Doob: an Ornstein-Uhlenbeck process is a Wiener process of stretched time, damped.
        tau = rng.uniform(0.5, 2.0) * hours[-1]
        stretched = np.exp(2.0 * hours / tau)
        wiener = np.cumsum(steps * np.sqrt(np.diff(stretched, prepend=stretched[0])))
        shape, path = "Ornstein-Uhlenbeck", np.sqrt(tau / 2.0) * np.exp(-hours / tau) * wiener
    centred = path - path.mean()
    return OutputEffect(name="bias_random_walk", shape=shape, added_v=lambda _, amplitude: amplitude * centred)


def spread_of_one(count: int, rng: np.random.Generator) -> FloatArray:
    """Normal numbers with mean 0 and sample standard deviation 1; zeros where there is only one."""
    drawn = rng.normal(size=count)
    return (drawn - drawn.mean()) / drawn.std(ddof=1) if count > 1 else np.zeros(count)


def _drawn_jumps(rng: np.random.Generator, run: Run) -> Effect:
    number = run.dwells.realisation - 1
    jump = spread_of_one(int(number[-1]) + 1, rng)[number]
    return OutputEffect(name="realisation_bias", added_v=lambda _, amplitude: amplitude * jump)


def _drawn_rectification(rng: np.random.Generator, run: Run) -> Effect:
    """Follows the variance that the dwell had, or the one that its vibration has in the long run."""
    measured = rng.uniform() < 0.5
    variance = (run.measured_sd_v if measured else run.expected_sd_v) ** 2
    return OutputEffect(
        name="vibration_rectification",
        shape="measured variance" if measured else "expected variance",
        sign=either_sign(rng),
        added_v=lambda _, amplitude: amplitude * variance,
    )


UNIT_EFFECTS: Final = MappingProxyType(
    {
        "k_xx": _product("k_xx", 0, 0),
        "k_yy": _product("k_yy", 1, 1),
        "k_zz": _product("k_zz", 2, 2),
        "k_xz": _product("k_xz", 0, 2),
        "k_yz": _product("k_yz", 1, 2),
        "k_xxx": _product("k_xxx", 0, 0, 0),
        "scale_asymmetry": _drawn_asymmetry,
        "hysteresis": drawn_hysteresis,
        "bias_temperature": _proportional("bias_temperature", _warmth),
        "scale_temperature": _proportional("scale_temperature", lambda scene: _warmth(scene) * scene.gravity[:, 0]),
        "bias_drift": _proportional("bias_drift", _hours),
        "scale_drift": _proportional("scale_drift", lambda scene: _hours(scene) * scene.gravity[:, 0]),
        "warm_up": _drawn_warm_up,
        "bias_random_walk": _drawn_wandering,
        "realisation_bias": _drawn_jumps,
        "vibration_rectification": _drawn_rectification,
    }
)
"""How to draw each effect that belongs to the unit."""
