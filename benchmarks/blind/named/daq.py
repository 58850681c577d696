"""Effects of the DAQ that the contract names (effects.md); they act on the voltage that it is given.

`latency` needs a head that moves while it is read, and is not in tables of dwells.
"""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import Draw, Family
from benchmarks.blind.world import Acts, Effect, Unit, World


def settling(fraction: float) -> Effect:
    """A part of the reading before remains, where one dwell followed directly on the other."""

    def amount(world: World) -> FloatArray:
        before_v = np.r_[world.given_v[:1], world.given_v[:-1]]
        return np.where(world.run.follows, fraction * (before_v - world.given_v), 0.0)

    return Effect(name="settling", acts=Acts.READING, amount=amount, coefficients={"settling": fraction})


def _settling(_run: Run, _unit: Unit, _rng: np.random.Generator) -> Family:
    return settling


def _nonlinearity(_run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """A sine of the voltage; its phase is no coefficient of the contract."""
    period_v, phase = float(rng.uniform(0.15, 0.9)), float(rng.uniform(0.0, 2.0 * np.pi))
    return lambda size: Effect(
        name="daq_nonlinearity",
        acts=Acts.READING,
        amount=lambda world: size * np.sin(2.0 * np.pi * world.given_v / period_v + phase),
        coefficients={"amplitude": size, "period_V": period_v},
    )


def range_step(step_v: float, threshold_v: float) -> Effect:
    """An offset above a threshold."""
    return Effect(
        name="range_step",
        acts=Acts.READING,
        amount=lambda world: np.where(world.given_v > threshold_v, step_v, 0.0),
        coefficients={"step": step_v, "threshold_V": threshold_v},
    )


def _range_step(_run: Run, unit: Unit, rng: np.random.Generator) -> Family:
    threshold_v, sign = unit.u0 + unit.kx * float(rng.uniform(-0.7, 0.7)), float(rng.choice([-1.0, 1.0]))
    return lambda size: range_step(sign * size, threshold_v)


DRAWS: Final[Mapping[str, Draw]] = {
    "settling": _settling,
    "daq_nonlinearity": _nonlinearity,
    "range_step": _range_step,
}


def stated(name: str, values: Mapping[str, Any]) -> Effect | None:
    """Return the effect that a result states, from its coefficients; None where they do not fix its course."""
    if name == "settling":
        return settling(values[name])
    return range_step(values["step"], values["threshold_V"]) if name == "range_step" else None
