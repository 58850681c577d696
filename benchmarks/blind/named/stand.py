"""Effects of the stand that the contract names (effects.md); true angle = reported angle + error."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.named import signed
from benchmarks.blind.named.signed import Form, hours
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import Draw, Family
from benchmarks.blind.world import Acts, Effect, Unit, World

_ORDERS: Final = {"head_eccentricity": 1, "head_second_harmonic": 2}
_GRADUATION: Final = (3, 13)
_ROUND_DEG: Final = (0.5, 1.0, 5.0, 10.0)
_STEEP: Final = 0.6


def _harmonic(name: str, order: int, amplitude_deg: float, phase_deg: float) -> Effect:
    """A sin(nφ + p), φ the head angle as reported."""
    told = {"amplitude_deg": amplitude_deg, "phase_deg": phase_deg}
    return Effect(
        name=name,
        acts=Acts.ANGLE,
        amount=lambda world: amplitude_deg * np.sin(np.radians(order * world.run.angle_deg + phase_deg)),
        coefficients=told if name in _ORDERS else {"order": order, **told},
    )


def _harmonics(name: str, first: int, beyond: int) -> Draw:
    """A harmonic whose order is drawn from a range."""

    def draw(_run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
        order, phase_deg = int(rng.integers(first, beyond)), float(rng.uniform(-180.0, 180.0))
        return lambda size: _harmonic(name, order, size, phase_deg)

    return draw


def _after_minus(world: World) -> FloatArray:
    return (world.run.direction < 0).astype(np.float64)


def _always(world: World) -> FloatArray:
    return np.ones(len(world.run.time_s))


_SIGNED: Final[Mapping[str, tuple[Acts, Form]]] = {
    "backlash": (Acts.ANGLE, _after_minus),
    "axis_tilt": (Acts.TILT, _always),
    "base_tilt_drift": (Acts.ANGLE, hours),
}


def _seating(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """An angle for each mounting; their mean belongs to alpha0 (result.md)."""
    angles = rng.normal(size=run.seating.max() + 1)
    held = angles[np.unique(run.seating[~run.fresh])]
    spread = float(held.std(ddof=1)) if len(held) > 1 else 0.0
    return signed.given("seating", Acts.ANGLE, (angles - held.mean())[run.seating], spread)


def _misreading(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """One to three rows read wrong by a round amount, where the output is steep enough to see it; of no size."""
    turn = np.radians(run.angle_deg)
    slope = np.abs(np.where(run.mount == "face-up-90", np.sin(turn), np.cos(turn)))
    steep = np.flatnonzero(~run.fresh & (slope > _STEEP) & (run.mount != "end"))
    rows = np.sort(rng.choice(steep, size=int(rng.integers(1, 4)), replace=False))
    error_deg = float(rng.choice(_ROUND_DEG) * rng.choice([-1.0, 1.0]))
    course = np.where(np.isin(np.arange(len(turn)), rows), error_deg, 0.0)
    told = {"rows": [int(row) + 1 for row in rows], "error_deg": error_deg}
    return lambda _: Effect(name="misreading", acts=Acts.ANGLE, amount=lambda _world: course, coefficients=told)


DRAWS: Final[Mapping[str, Draw]] = {
    "head_eccentricity": _harmonics("head_eccentricity", 1, 2),
    "head_second_harmonic": _harmonics("head_second_harmonic", 2, 3),
    "graduation": _harmonics("graduation", *_GRADUATION),
    **{name: signed.drawn(name, *acting) for name, acting in _SIGNED.items()},
    "seating": _seating,
    "misreading": _misreading,
}


def stated(name: str, values: Mapping[str, Any]) -> Effect | None:
    """Return the effect that a result states, from its coefficients; None where they do not fix its course."""
    if name in _ORDERS or name == "graduation":
        order = _ORDERS.get(name) or round(values["order"])
        return _harmonic(name, order, values["amplitude_deg"], values["phase_deg"])
    return signed.stated(_SIGNED, name, values)
