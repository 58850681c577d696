"""Which settings a run takes, in which order: programmes of flips and sweeps (domain.md, section 1; stand.md)."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from benchmarks.blind.geometry import FloatArray


@dataclass(frozen=True)
class Part:
    """One procedure in one mount: the angles in the order in which they are set."""

    procedure: str
    mount: str
    angles_deg: FloatArray


Design = Callable[[np.random.Generator], list[Part]]
"""Draws one realisation."""


def _flips() -> list[Part]:
    """x, y and z flips: face-up at the x and y poles, edge at the z poles (observations.md)."""
    return [
        Part("flip", "face-up", np.array([-90.0, 90.0, 180.0, 0.0])),
        Part("flip", "edge", np.array([180.0, 0.0])),
    ]


def _sweep(mount: str, start_deg: float, step_deg: float, points: int) -> Part:
    return Part("sweep", mount, start_deg + step_deg * np.arange(points, dtype=np.float64))


def _there_and_back(part: Part) -> Part:
    return Part(part.procedure, part.mount, np.r_[part.angles_deg, part.angles_deg[::-1]])


def seed(_: np.random.Generator) -> list[Part]:
    """The published programme: flips, and 80 points of 5° over 400°, upwards."""
    return [*_flips(), _sweep("face-up", 0.0, 5.0, 80)]


def mounts(_: np.random.Generator) -> list[Part]:
    """Flips, and sweeps there and back in face-up, face-down and face-up-90."""
    sweeps = [_sweep(mount, 0.0, 10.0, 37) for mount in ("face-up", "face-down", "face-up-90")]
    return [*_flips(), *map(_there_and_back, sweeps)]


def all_mounts(_: np.random.Generator) -> list[Part]:
    """Flips, and a sweep in every mount, there and back in face-up."""
    others = ("face-up-90", "face-down", "edge", "edge-back", "end")
    return [
        *_flips(),
        _there_and_back(_sweep("face-up", 0.0, 10.0, 40)),
        *(_sweep(mount, 0.0, 10.0, 37) for mount in others),
    ]


def shuffled(rng: np.random.Generator) -> list[Part]:
    """As `mounts`, each sweep in an order of its own."""
    return [Part(part.procedure, part.mount, rng.permutation(part.angles_deg)) for part in mounts(rng)]


def turns(_: np.random.Generator) -> list[Part]:
    """Flips, and two turns there and back in face-up, one turn in face-down and face-up-90."""
    others = (_sweep("face-down", -180.0, 10.0, 55), _sweep("face-up-90", 90.0, 10.0, 55))
    return [*_flips(), _there_and_back(_sweep("face-up", 0.0, 10.0, 73)), *others]


def irregular(rng: np.random.Generator) -> list[Part]:
    """As `mounts`, at angles without a grid, the same in each realisation of a run."""
    angles_deg = np.sort(rng.uniform(0.0, 400.0, 40)).round(2)
    sweeps = [Part("sweep", mount, angles_deg) for mount in ("face-up", "face-down", "face-up-90")]
    return [*_flips(), *map(_there_and_back, sweeps)]


def partial(rng: np.random.Generator) -> list[Part]:
    """Flips, and sweeps over 150° to 210° only, in face-up and face-down."""
    start_deg, points = float(5.0 * rng.integers(0, 30)), int(rng.integers(31, 43))
    sweeps = [_sweep(mount, start_deg, 5.0, points) for mount in ("face-up", "face-down")]
    return [*_flips(), *map(_there_and_back, sweeps)]


def flips(_: np.random.Generator) -> list[Part]:
    """Flips only, each twice."""
    return [*_flips(), *_flips()]


DESIGNS: Final[Mapping[str, Design]] = {
    design.__name__: design for design in (seed, mounts, all_mounts, shuffled, turns, irregular, partial, flips)
}
