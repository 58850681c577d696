"""Tables of few settings with many repeats: what a bench without a motor gives, and what says least of a shape.

A table has a number of settings over an arc, each repeated: in *pieces* (set once, read again and again) or in *passes*
(set anew each time). Nothing of the catalogue is in it. It is clean; or the response bends smoothly, in no shape that
the catalogue has; or every setting is off by a little of its own, as angles set by hand are, which pieces share.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import drawn_unit
from benchmarks.bank.table import Case, Spec, Truth
from tumble.calibrations.methods.dividing_head.observations import Observations

SETTINGS: Final = (5, 7, 9, 12, 17)
REPEATS: Final = (2, 4, 20)
ARCS_DEG: Final = (20.0, 41.0, 60.0, 180.0, 360.0)
KINDS: Final = ("clean", "bend", "by hand")
_LAYOUTS: Final = ("pieces", "passes", "two temperatures", "labelled pieces")
NOISE_V: Final = 1e-4
_SIGNALS_V: Final = (1e-3, 1e-2)
"""Size of what is there and has no name."""


@dataclass(frozen=True, kw_only=True)
class SparseSpec:
    """What a table is to hold. A table is fixed by its spec and a seed."""

    settings: int
    repeats: int
    arc_deg: float
    """0: the six poses of three flips."""
    kind: str
    layout: str
    signal_v: float


def sparse(seeds: range, count: int) -> list[tuple[SparseSpec, int]]:
    """Tables drawn over all designs, kinds by turns; a longer list begins as a shorter one does."""
    return [
        (_drawn(number, np.random.default_rng((seeds[_FIRST + number], 0))), seeds[_FIRST + number])
        for number in range(count)
    ]


_FIRST: Final = 900_000


def _drawn(number: int, rng: np.random.Generator) -> SparseSpec:
    arc_deg = float(rng.choice([*ARCS_DEG, 0.0]))
    return SparseSpec(
        settings=int(rng.choice(SETTINGS)) if arc_deg else 6,
        repeats=int(rng.choice(REPEATS)),
        arc_deg=arc_deg,
        kind=KINDS[number % len(KINDS)],
        layout=str(rng.choice(_LAYOUTS)),
        signal_v=float(rng.choice(_SIGNALS_V)),
    )


def make_sparse(spec: SparseSpec, seed: int) -> Case:
    """Make the table. Of its truth there is the unit; nothing in it has a name."""
    rng = np.random.default_rng((seed, 1))
    angle_deg, mount = _poses(spec, rng)
    order = np.arange(len(angle_deg))
    passes = spec.layout in ("passes", "two temperatures")
    place = np.tile(order, spec.repeats) if passes else np.repeat(order, spec.repeats)
    repeat = np.repeat(np.arange(spec.repeats), len(order)) if passes else np.tile(np.arange(spec.repeats), len(order))
    off_deg = _off_deg(spec, passes, len(order), rng)[repeat, place]
    unit = drawn_unit(rng)
    gravity = _gravity(mount[place], angle_deg[place] + off_deg + unit.alpha0_deg)
    true_v = unit.output_v(gravity) + (spec.signal_v * _bend(gravity[:, 0], rng) if spec.kind == "bend" else 0.0)
    volts = true_v + rng.normal(0.0, NOISE_V, len(place))
    warm = spec.layout == "two temperatures"
    temperature_degc = 20.0 + 20.0 * (repeat >= spec.repeats / 2) + rng.normal(0.0, 0.02, len(place))
    observations = Observations(
        row=np.arange(1, len(place) + 1),
        angle_deg=angle_deg[place],
        mount=mount[place],
        voltage_v=volts,
        time_s=10.0 * np.arange(len(place)),
        realisation=None if spec.layout == "pieces" else repeat + 1,
        temperature_degc=temperature_degc if warm else None,
        source=f"sparse {seed}",
    )
    truth = Truth(
        seed=seed,
        spec=Spec(design="sparse", realisations=spec.repeats),
        unit=unit,
        effects=(),
        novel={},
        coefficients={},
        shapes={},
        visible={},
        noise_free_v=true_v,
        novel_v=np.zeros(len(true_v)),
    )
    return Case(observations=observations, truth=truth)


def _poses(spec: SparseSpec, rng: np.random.Generator) -> tuple[FloatArray, np.ndarray]:
    if not spec.arc_deg:
        return np.array([-90.0, 90.0, 180.0, 0.0, 180.0, 0.0]), np.array(["face-up"] * 4 + ["edge"] * 2)
    start_deg = float(rng.choice([-90.0, 0.0, 15.0]))
    spaces = spec.settings if spec.arc_deg == 360.0 else spec.settings - 1
    angle_deg = start_deg + spec.arc_deg / spaces * np.arange(spec.settings)
    return angle_deg, np.full(spec.settings, "face-up")


def _off_deg(spec: SparseSpec, passes: bool, settings: int, rng: np.random.Generator) -> FloatArray:
    """What every setting is off by, shape (repeats, settings): pieces share it, passes do not."""
    if spec.kind != "by hand":
        return np.zeros((spec.repeats, settings))
    size_deg = np.rad2deg(spec.signal_v)
    drawn = rng.normal(0.0, size_deg, (spec.repeats, settings))
    return drawn if passes else np.repeat(drawn[:1], spec.repeats, axis=0)


def _gravity(mount: np.ndarray, angle_deg: FloatArray) -> FloatArray:
    sine, cosine, none = np.sin(np.deg2rad(angle_deg)), np.cos(np.deg2rad(angle_deg)), np.zeros(len(angle_deg))
    edge = (mount == "edge")[:, None]
    return np.asarray(np.where(edge, np.column_stack([-sine, none, -cosine]), np.column_stack([-sine, -cosine, none])))


def _bend(ax_g: FloatArray, rng: np.random.Generator) -> FloatArray:
    """A smooth bend of the response that is no square, no cubic, no wave: how a spring stiffens near its stop."""
    towards = rng.choice([-1.0, 1.0])
    steep = rng.uniform(1.5, 4.0)
    return np.asarray(
        (np.exp(steep * (towards * ax_g - 1.0)) - np.exp(-2.0 * steep)) * np.cos(rng.uniform(0.5, 2.0) * ax_g)
    )
