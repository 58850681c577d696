"""Effects of the stand that the contract names (effects.md); true angle = reported angle + error."""

from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import Draw, Family
from benchmarks.blind.world import Acts, Effect, Unit, World

_S_PER_H: Final = 3600.0


def harmonic(name: str, order: int, amplitude_deg: float, phase_deg: float) -> Effect:
    """A sin(nφ + p), φ the head angle as reported."""
    return Effect(
        name=name,
        acts=Acts.ANGLE,
        amount=lambda world: amplitude_deg * np.sin(np.radians(order * world.run.angle_deg + phase_deg)),
        coefficients={"amplitude_deg": amplitude_deg, "phase_deg": phase_deg}
        | ({"order": order} if name == "graduation" else {}),
    )


def _harmonic(name: str, orders: tuple[int, int]) -> Draw:
    def draw(_run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
        order, phase_deg = int(rng.integers(orders[0], orders[1] + 1)), float(rng.uniform(-180.0, 180.0))
        return lambda size: harmonic(name, order, size, phase_deg)

    return draw


def _signed(name: str, acts: Acts, form: Callable[[World], FloatArray]) -> Draw:
    def draw(_run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
        sign = float(rng.choice([-1.0, 1.0]))
        return lambda size: Effect(
            name=name, acts=acts, amount=lambda world: sign * size * form(world), coefficients={name: sign * size}
        )

    return draw


def _after_minus(world: World) -> FloatArray:
    return (world.run.direction < 0).astype(np.float64)


def _hours(world: World) -> FloatArray:
    return world.run.time_s / _S_PER_H


def _seating(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """An angle for each mounting; their mean belongs to alpha0 (result.md)."""
    angles = rng.normal(size=run.seating.max() + 1)
    held = angles[np.unique(run.seating[~run.fresh])]
    course, spread = (angles - held.mean())[run.seating], float(held.std(ddof=1)) if len(held) > 1 else 0.0
    return lambda size: Effect(
        name="seating", acts=Acts.ANGLE, amount=lambda _: size * course, coefficients={"seating": size * spread}
    )


_ROUND_DEG: Final = (0.5, 1.0, 5.0, 10.0)
_STEEP: Final = 0.6


def _misreading(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """One to three rows read wrong by a round amount, where the output is steep enough to see it; of no size."""
    slope = np.abs(np.where(run.mount == "face-up-90", np.sin(np.radians(run.angle_deg)), _cosine(run)))
    steep = np.flatnonzero(~run.fresh & (slope > _STEEP) & (run.mount != "end"))
    rows = np.sort(rng.choice(steep, size=int(rng.integers(1, 4)), replace=False))
    error_deg = float(rng.choice(_ROUND_DEG) * rng.choice([-1.0, 1.0]))
    course = np.where(np.isin(np.arange(len(slope)), rows), error_deg, 0.0)
    coefficients = {"rows": [int(row) + 1 for row in rows], "error_deg": error_deg}
    return lambda _: Effect(name="misreading", acts=Acts.ANGLE, amount=lambda _world: course, coefficients=coefficients)


def _cosine(run: Run) -> FloatArray:
    return np.asarray(np.cos(np.radians(run.angle_deg)))


DRAWS: Final[Mapping[str, Draw]] = {
    "head_eccentricity": _harmonic("head_eccentricity", (1, 1)),
    "head_second_harmonic": _harmonic("head_second_harmonic", (2, 2)),
    "graduation": _harmonic("graduation", (3, 12)),
    "backlash": _signed("backlash", Acts.ANGLE, _after_minus),
    "axis_tilt": _signed("axis_tilt", Acts.TILT, lambda world: np.ones(len(world.run.time_s))),
    "base_tilt_drift": _signed("base_tilt_drift", Acts.ANGLE, _hours),
    "seating": _seating,
    "misreading": _misreading,
}

_ORDERS: Final = {"head_eccentricity": 1, "head_second_harmonic": 2}
_STATED: Final[Mapping[str, tuple[Acts, Callable[[World], FloatArray]]]] = {
    "backlash": (Acts.ANGLE, _after_minus),
    "axis_tilt": (Acts.TILT, lambda world: np.ones(len(world.run.time_s))),
    "base_tilt_drift": (Acts.ANGLE, _hours),
}


def stated(name: str, values: Mapping[str, Any]) -> Effect | None:
    """Return the effect that a result states, from its coefficients; None where they do not fix its course."""
    if name in _ORDERS or name == "graduation":
        order = _ORDERS.get(name) or round(values["order"])
        return harmonic(name, order, values["amplitude_deg"], values["phase_deg"])
    if name not in _STATED:
        return None
    acts, form = _STATED[name]
    return Effect(name=name, acts=acts, amount=lambda world: values[name] * form(world), coefficients=values)
