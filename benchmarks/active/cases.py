"""Units, heads, seats and first programmes, drawn from a seed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np

FIRST: Final = 970_000
"""Among the seeds of the bank, beyond those of its lists."""
SWEEP = '\n[[procedure]]\nkind = "sweep"\nmount = "{}"\nstep_deg = 5.0\npoints = POINTS\norder = "{}"\n'
FLIPS = '\n[[procedure]]\nkind = "flip"\naxes = ["x", "y", "z"]\n'
NOISE: Final = "noise_v = 1e-3"
"""Of a sample, in a stand file."""
DWELL_V: Final = 1e-4
"""Noise of a dwell of a hundred samples."""
_PROGRAMMES: Final = {
    "flips and sweep": FLIPS + SWEEP.format("face-up", "up"),
    "sweep": SWEEP.format("face-up", "up"),
    "there and back": FLIPS + SWEEP.format("face-up", "there-and-back"),
    "two mounts": FLIPS + SWEEP.format("face-up", "up") + SWEEP.format("face-down", "up"),
}
_STANDS: Final = {
    "every mount": "",
    "half a turn": "limits_deg = [-95.0, 185.0]",
    "flat mounts only": 'mounts = ["face-up", "face-down", "edge"]',
    "flat mounts only, half a turn": 'mounts = ["face-up", "face-down", "edge"]\nlimits_deg = [-95.0, 185.0]',
}
"""Of seats: those of the flips are always there."""
_CHANCES: Final = (0.4, 0.1, 0.35, 0.15)
"""Of the stands."""

Rng = np.random.Generator


@dataclass(frozen=True, kw_only=True)
class Case:
    """What is written for a case, and what is true of it."""

    seed: int
    effect: str
    outside: bool
    """Whether the effect stands in a physics file."""
    first: str
    """Which first programme."""
    seat: str
    """Which stand."""
    programme_text: str
    stand_text: str
    physics_text: str = field(default="", repr=False)


Physics = Callable[[Rng, dict[str, float]], tuple[str, str]]
"""Makes a physics file for a unit: the key under which a stand names it, and its text."""


def make(seed: int) -> Case:
    """The case of a seed, one in three with a physics file."""
    rng = np.random.default_rng(seed)
    rng.choice(list(_PROGRAMMES)), rng.choice(list(_STANDS), p=_CHANCES)
    return made(seed, _OUTSIDE if rng.random() < 1 / 3 else {})


def made(
    seed: int,
    physics_files: Mapping[str, Physics],
    programmes: Mapping[str, str] = _PROGRAMMES,
    realisations: tuple[int, int] = (2, 3),
) -> Case:
    """The case of a seed with one of the physics files; with a named effect of the simulation where there are none.

    The first programme is one of `programmes`, with so many realisations at least and at most.
    """
    rng = np.random.default_rng(seed)
    first, seat = str(rng.choice(list(programmes))), str(rng.choice(list(_STANDS), p=_CHANCES))
    rng.random()
    outside = bool(physics_files)
    effect = str(rng.choice(list(physics_files or _INSIDE)))
    unit = {
        "u0": rng.uniform(2.0, 3.0),
        "kx": rng.uniform(0.9, 1.1),
        "ky": rng.uniform(-0.02, 0.02),
        "kz": rng.uniform(-0.02, 0.02),
        "kxy": rng.uniform(1e-3, 3e-3) * rng.choice([-1, 1]),
        "alpha0_deg": rng.uniform(-0.3, 0.3),
    }
    if outside:
        key, physics = physics_files[effect](rng, unit)
        simulated = [f'{key} = "physics.py:{key}"', f"parameters = {_inline(unit)}"]
    else:
        physics = ""
        simulated = [f"parameters = {_inline(unit)}", f"effects = {{ {effect} = {_INSIDE[effect](rng)} }}"]
    ramp = rng.uniform(2.0, 4.0) if "temperature" in effect else 0.0
    simulated += [f"seed = {seed}", NOISE, f"temperature = {{ ramp_K_per_h = {ramp} }}"]
    points = "37" if "half a turn" in seat else "80"
    procedures = programmes[first].replace("POINTS", points)
    realisation_count = rng.integers(realisations[0], realisations[1] + 1)
    return Case(
        seed=seed,
        effect=effect,
        outside=outside,
        first=first,
        seat=seat,
        programme_text=f'name = "first"\nrealisations = {realisation_count}\ndwell_s = 1.0\n{procedures}',
        stand_text=_stand(_STANDS[seat], simulated),
        physics_text=physics,
    )


def _stand(head: str, simulated: list[str]) -> str:
    limits = "" if "limits_deg" in head else "limits_deg = [-180.0, 760.0]\n"
    return f'name = "bench"\n[head]\ndriver = "simulated"\n{limits}{head}\n[daq]\ndriver = "simulated"\n' + "\n".join(
        ["[simulated]", *simulated, ""]
    )


def _inline(values: dict[str, float]) -> str:
    return "{ " + ", ".join(f"{name} = {float(value)!r}" for name, value in values.items()) + " }"


def _size(low: float, high: float) -> Callable[[Rng], str]:
    """A number of either sign."""
    return lambda rng: repr(drawn(rng, low, high) * int(rng.choice([-1, 1])))


def drawn(rng: Rng, low: float, high: float) -> float:
    """A size: small ones are as many as large ones."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def _wave(low: float, high: float) -> Callable[[Rng], str]:
    return lambda rng: _inline({"amplitude_deg": drawn(rng, low, high), "phase_deg": rng.uniform(0.0, 360.0)})


_INSIDE: Final[dict[str, Callable[[Rng], str]]] = {
    "k_xx": _size(1e-4, 8e-4),
    "k_yy": _size(1e-4, 8e-4),
    "k_zz": _size(1e-4, 8e-4),
    "k_yz": _size(1e-4, 8e-4),
    "k_xxx": _size(1.5e-4, 1e-3),
    "scale_asymmetry": _size(1e-4, 8e-4),
    "hysteresis": _size(4e-5, 3e-4),
    "settling": _size(2e-4, 2e-3),
    "bias_temperature": _size(1e-4, 6e-4),
    "bias_drift": _size(2e-4, 2e-3),
    "base_tilt_drift": _size(0.015, 0.1),
    "backlash": _size(0.003, 0.02),
    "axis_tilt": _size(0.5, 3.0),
    "head_eccentricity": _wave(0.006, 0.05),
    "head_second_harmonic": _wave(0.006, 0.05),
    "daq_nonlinearity": lambda rng: _inline({"amplitude": drawn(rng, 5e-5, 3e-4), "period_V": rng.uniform(0.4, 1.5)}),
}


def _response(term: str) -> Callable[[Rng, dict[str, float]], tuple[str, str]]:
    """A unit of somebody else's: the declared response, written out, with one term more, of a size of its own."""

    def physics(rng: Rng, unit: dict[str, float]) -> tuple[str, str]:
        size = drawn(rng, 1e-4, 8e-4) * int(rng.choice([-1, 1]))
        numbers = [float(unit[name]) for name in ("u0", "kx", "ky", "kz", "kxy")]
        return "response", (
            f"U0, KX, KY, KZ, KXY = {numbers}\nSIZE = {size!r}\n\n\n"
            "def response(ax, ay, az, temperature_degc, time_s):\n"
            f"    return U0 + ax * (KX + KXY * ay) + KY * ay + KZ * az + SIZE * {term}\n"
        )

    return physics


def _head_error(body: str, low: float, high: float) -> Callable[[Rng, dict[str, float]], tuple[str, str]]:
    """A head of somebody else's."""

    def physics(rng: Rng, _unit: dict[str, float]) -> tuple[str, str]:
        size, phase = drawn(rng, low, high), float(rng.uniform(0.0, 360.0))
        return "head_error", (
            f"from math import atan2, cos, degrees, radians, sin\n\nSIZE, PHASE = {size!r}, {phase!r}\n\n\n"
            f"def head_error(angle_deg, direction, time_s):\n    turn = radians(angle_deg + PHASE)\n    return {body}\n"
        )

    return physics


_OUTSIDE: Final[dict[str, Callable[[Rng, dict[str, float]], tuple[str, str]]]] = {
    "k_xx": _response("ax * ax"),
    "k_yy": _response("ay * ay"),
    "k_zz": _response("az * az"),
    "k_xxx": _response("1.5 * ax * ax * ax"),
    "scale_asymmetry": _response("max(ax, -ax)"),
    "head_eccentricity": _head_error(
        "degrees(atan2(radians(SIZE) * sin(turn), 1 + radians(SIZE) * cos(turn)))", 0.006, 0.05
    ),
    "head_second_harmonic": _head_error("2 * SIZE * sin(turn) * cos(turn)", 0.006, 0.05),
    "backlash": _head_error("-SIZE if direction < 0 else 0.0", 0.003, 0.02),
}
