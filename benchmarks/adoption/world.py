"""Unit types, drawn from a seed: the declared response with one term more, in a physics file of each unit's own."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from tumble.app.running import Job, failure, run
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.procedures.programmes import load_programme

SPREAD: Final = 0.2
"""Of the size from unit to unit, in those of the mean."""
NOISE_V: Final = 1e-3
"""Of one sample; a dwell is the mean of a hundred."""
DWELL_V: Final = NOISE_V / 10.0
Rng = np.random.Generator

_STAND: Final = """\
name = "bench"
[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]
serial = "H-1"
[daq]
driver = "simulated"
serial = "D-1"
[simulated]
seed = {seed}
noise_v = {noise_v}
response = "{physics}:response"
parameters = {{ {parameters} }}
"""
_PHYSICS: Final = """\
import math

U0, KX, KY, KZ, KXY = {numbers}


def response(ax, ay, az, temperature_degc, time_s):
    return U0 + ax * (KX + KXY * ay) + KY * ay + KZ * az + {size!r} * ({term})
"""
PROGRAMME: Final = """\
name = "first"
unit_type = "{unit_type}"
realisations = 3
dwell_s = 1.0
[[procedure]]
kind = "flip"
axes = ["x", "y", "z"]
[[procedure]]
kind = "sweep"
mount = "face-up"
step_deg = 5.0
points = 73
order = "up"
"""


@dataclass(frozen=True, kw_only=True)
class UnitType:
    """What all units of a type have."""

    kind: str
    term: str
    """The effect of size 1, an expression of Python."""
    size_v: float
    """Its mean size, signed."""

    @property
    def name(self) -> str:
        """As programmes state it."""
        return f"bench {self.kind}"


@dataclass(frozen=True, kw_only=True)
class Unit:
    """One unit: its parameters, and how much of the effect it has."""

    serial_number: str
    seed: int
    size: float
    """In those of the mean of its type."""
    truth: dict[str, float]
    """u0, kx, ky, kz, kxy and alpha0, the effect absent."""


def _bump(rng: Rng) -> str:
    return f"math.exp(-0.5 * ((ax - {rng.uniform(-0.6, 0.6):.3f}) / {rng.uniform(0.1, 0.2):.3f}) ** 2)"


def _dead_zone(rng: Rng) -> str:
    width_g = rng.uniform(0.1, 0.2)
    return f"1.65 * ax / {width_g:.3f} * math.exp(-0.5 * (ax / {width_g:.3f}) ** 2)"


def _ripple(rng: Rng) -> str:
    """A wave of ax that grows towards one end: no wave of the converter, and no polynomial."""
    return (
        f"0.5 * math.exp(0.7 * ax) * math.sin({rng.uniform(6.0, 9.0):.3f} * ax * abs(ax) + {rng.uniform(0, 6.28):.3f})"
    )


_KINDS: Final[dict[str, Callable[[Rng], str]]] = {"bump": _bump, "dead zone": _dead_zone, "ripple": _ripple}


def unit_type(seed: int) -> UnitType:
    """The type of a seed; kinds take turns."""
    rng = np.random.default_rng(seed)
    kind = list(_KINDS)[seed % len(_KINDS)]
    return UnitType(kind=kind, term=_KINDS[kind](rng), size_v=float(rng.uniform(4e-4, 8e-4) * rng.choice([-1.0, 1.0])))


def unit(seed: int, number: int, *, lacking: bool = False) -> Unit:
    """One unit of the type of a seed."""
    rng = np.random.default_rng([seed, number])
    truth = {
        "u0": rng.uniform(2.0, 3.0),
        "kx": rng.uniform(0.9, 1.1),
        "ky": rng.uniform(-0.02, 0.02),
        "kz": rng.uniform(-0.02, 0.02),
        "kxy": rng.uniform(1e-3, 3e-3) * rng.choice([-1, 1]),
        "alpha0": rng.uniform(-0.3, 0.3),
    }
    size = 0.0 if lacking else 1.0 + SPREAD * rng.standard_normal()
    return Unit(
        serial_number=f"U-{number}",
        seed=int(rng.integers(2**31)),
        size=float(size),
        truth={name: float(value) for name, value in truth.items()},
    )


def measured(folder: Path, kind: UnitType, one: Unit) -> Path:
    """Carry out the programme on a unit, in virtual time; return the recording."""
    physics = folder / f"{one.serial_number.replace('-', '_')}.py"
    numbers = [one.truth[name] for name in ("u0", "kx", "ky", "kz", "kxy")]
    physics.write_text(_PHYSICS.format(numbers=numbers, size=kind.size_v * one.size, term=kind.term), "utf-8")
    stand = folder / f"{one.serial_number}.toml"
    parameters = ", ".join(f"{name.replace('alpha0', 'alpha0_deg')} = {value!r}" for name, value in one.truth.items())
    text = _STAND.format(seed=one.seed, noise_v=NOISE_V, physics=physics.name, parameters=parameters)
    stand.write_text(text, "utf-8")
    programme = folder / "programme.toml"
    programme.write_text(PROGRAMME.format(unit_type=kind.name), "utf-8")
    loaded, recording = load_stand(stand), folder / f"{one.serial_number}.mcap"
    job = Job(stand=loaded, programme=load_programme(programme), serial_number=one.serial_number)
    outcome = run(job, connect(loaded), recording)
    if error := failure(outcome, recording):
        raise error
    return recording
