"""Which tables are made: kinds of tables, each a list that the seed fixes."""

from collections.abc import Callable, Mapping
from itertools import cycle, islice
from typing import Final

import numpy as np

from benchmarks.blind.named import CATALOGUE
from benchmarks.blind.nuisances import MILD, NUISANCES, PLAIN
from benchmarks.blind.table import Spec
from benchmarks.blind.unnamed import KINDS

SIZES: Final = (12.0, 20.0, 40.0)
"""Noise units (effects.md)."""
TELLING: Final = ("mounts", "all_mounts", "shuffled", "turns")
"""Designs that part what the contract says can be parted."""
_DISTURBED: Final = 0.4

STANDS: Final[Mapping[str, tuple[str, ...]]] = {
    "worn_head": (
        "head_eccentricity", "head_second_harmonic", "graduation", "backlash", "axis_tilt", "seating",
    ),
    "warm_laboratory": (
        "bias_temperature", "scale_temperature", "base_tilt_drift", "scale_drift", "warm_up", "k_xx",
    ),
    "cheap_daq": ("settling", "daq_nonlinearity", "range_step", "bias_temperature", "k_xx", "graduation"),
    "soft_unit": ("k_xx", "k_xxx", "hysteresis", "scale_temperature", "realisation_bias", "head_eccentricity"),
}  # fmt: skip
"""Stands as they are met: of each, three to six of these effects are there at once, all small."""


def _nuisance(rng: np.random.Generator) -> str:
    return str(rng.choice(MILD)) if rng.random() < _DISTURBED else PLAIN


def unnamed(count: int, rng: np.random.Generator) -> list[Spec]:
    """Each kind in turn; sizes in turn."""
    return [
        Spec(
            kind="unnamed",
            designs=KINDS[name].designs,
            nuisance=_nuisance(rng) if len(KINDS[name].designs) > 3 else PLAIN,
            effects=((name, SIZES[(place + place // len(KINDS)) % 3]),),
        )
        for place, name in enumerate(islice(cycle(KINDS), count))
    ]


def single(count: int, rng: np.random.Generator) -> list[Spec]:
    """Each effect of the catalogue in turn."""
    return [
        Spec(
            kind="single",
            designs=(*TELLING, "seed"),
            nuisance=_nuisance(rng),
            effects=((name, SIZES[(place + place // len(CATALOGUE)) % 3]),),
        )
        for place, name in enumerate(islice(cycle(CATALOGUE), count))
    ]


def _several(kind: str, number: int, count: int, rng: np.random.Generator) -> list[Spec]:
    names = list(CATALOGUE)
    return [
        Spec(
            kind=kind,
            designs=TELLING,
            effects=tuple(
                (str(name), float(rng.choice(SIZES))) for name in rng.choice(names, size=number, replace=False)
            ),
        )
        for _ in range(count)
    ]


def pairs(count: int, rng: np.random.Generator) -> list[Spec]:
    """Two effects of the catalogue at once."""
    return _several("pairs", 2, count, rng)


def triples(count: int, rng: np.random.Generator) -> list[Spec]:
    """Three effects of the catalogue at once."""
    return _several("triples", 3, count, rng)


def stands(count: int, rng: np.random.Generator) -> list[Spec]:
    """Three to six small effects of one stand at once."""
    specs = []
    for _, members in islice(cycle(STANDS.items()), count):
        there = rng.choice(members, size=int(rng.integers(3, 7)), replace=False)
        effects = tuple((str(name), float(rng.choice(SIZES[:2]))) for name in there)
        specs.append(Spec(kind="stands", designs=("mounts", "all_mounts"), effects=effects))
    return specs


def clean(count: int, rng: np.random.Generator) -> list[Spec]:  # noqa: ARG001 (all lists are called alike)
    """Nothing there, each nuisance in turn."""
    turn = islice(cycle((PLAIN, *NUISANCES)), count)
    return [Spec(kind="clean", designs=(*TELLING, "seed"), nuisance=nuisance) for nuisance in turn]


LISTS: Final[Mapping[str, Callable[[int, np.random.Generator], list[Spec]]]] = {
    made.__name__: made for made in (unnamed, single, pairs, triples, stands, clean)
}
