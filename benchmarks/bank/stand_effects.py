"""Effects of the stand: errors of the angle, true angle = reported + error."""

from types import MappingProxyType
from typing import Final

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import AngleEffect, Effect, Run, TiltEffect
from benchmarks.bank.unit_effects import HOUR_S, Draw, either_sign, spread_of_one


def _wave(angle_deg: FloatArray, order: int, phase_deg: float) -> FloatArray:
    return np.asarray(np.sin(np.deg2rad(order * angle_deg + phase_deg)))


def harmonic(name: str, order: int, phase_deg: float, run: Run) -> AngleEffect:
    """Make a pure harmonic error of the angle, A sin(order φ + phase)."""
    wave = _wave(run.dwells.angle_deg, order, phase_deg)
    return AngleEffect(
        name=name,
        amplitude_key="amplitude_deg",
        others={"phase_deg": phase_deg},
        error_deg=lambda _, amplitude: amplitude * wave,
    )


def _per_turn(name: str, order: int) -> Draw:
    return lambda rng, run: harmonic(name, order, float(rng.uniform(0.0, 360.0)), run)


def _drawn_graduation(rng: np.random.Generator, run: Run) -> Effect:
    """Three to twelve per turn, pure or with a small wave of twice the order."""
    order, phase_deg = int(rng.integers(3, 13)), float(rng.uniform(0.0, 360.0))
    overtone = 0.0 if rng.uniform() < 0.5 else float(rng.uniform(0.05, 0.2))
    angle_deg = run.dwells.angle_deg
    wave = _wave(angle_deg, order, phase_deg)
    wave = wave + overtone * _wave(angle_deg, 2 * order, float(rng.uniform(0.0, 360.0)))
    return AngleEffect(
        name="graduation",
        shape="with overtone" if overtone else "pure",
        amplitude_key="amplitude_deg",
        others={"order": order, "phase_deg": phase_deg},
        error_deg=lambda _, amplitude: amplitude * wave,
    )


def _drawn_backlash(rng: np.random.Generator, run: Run) -> Effect:
    """There at once after a - move, or only once the head has moved by a slack of a few degrees."""
    slack_deg = 0.0 if rng.uniform() < 0.6 else float(rng.uniform(2.0, 9.0))
    dwells = run.dwells
    developed = _taken_up(dwells.angle_deg, slack_deg) if slack_deg else (dwells.direction < 0).astype(float)
    return AngleEffect(
        name="backlash",
        shape="with slack" if slack_deg else "constant",
        sign=either_sign(rng),
        error_deg=lambda _, amplitude: amplitude * developed,
    )


def _taken_up(angle_deg: FloatArray, slack_deg: float) -> FloatArray:
    """Part of the backlash that shows: 0 after a long + move, 1 after a long - move."""
    part, parts = 0.0, []
    for move_deg in np.diff(angle_deg, prepend=angle_deg[0]).tolist():
        part = min(max(part - move_deg / slack_deg, 0.0), 1.0)
        parts.append(part)
    return np.array(parts)


def _drawn_lean(rng: np.random.Generator, run: Run) -> Effect:
    hours = run.dwells.elapsed_s / HOUR_S
    return AngleEffect(name="base_tilt_drift", sign=either_sign(rng), error_deg=lambda _, amplitude: amplitude * hours)


def _drawn_seating(rng: np.random.Generator, run: Run) -> Effect:
    mounting = run.dwells.mounting
    seat = spread_of_one(int(mounting[-1]) + 1, rng)[mounting]
    return AngleEffect(name="seating", error_deg=lambda _, amplitude: amplitude * seat)


STAND_EFFECTS: Final = MappingProxyType(
    {
        "head_eccentricity": _per_turn("head_eccentricity", 1),
        "head_second_harmonic": _per_turn("head_second_harmonic", 2),
        "graduation": _drawn_graduation,
        "backlash": _drawn_backlash,
        "axis_tilt": lambda rng, _: TiltEffect(name="axis_tilt", sign=either_sign(rng)),
        "base_tilt_drift": _drawn_lean,
        "seating": _drawn_seating,
    }
)
"""How to draw each effect that belongs to the stand, single misreadings apart."""
