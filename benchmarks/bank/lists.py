"""What the bank consists of: lists of (spec, seed), each with seeds of its own.

The seeds are fixed beforehand. Those of `DEVELOPMENT` may be looked at while an analysis is written; those of
`REPORTED` are run once, for the numbers that are published. No seed is in both, nor in two lists.
"""

from itertools import combinations
from typing import Final

import numpy as np

from benchmarks.bank.catalogue import NAMED
from benchmarks.bank.novel import NOVEL
from benchmarks.bank.table import Spec

Wanted = list[tuple[Spec, int]]

DEVELOPMENT: Final = range(1_000_000, 2_000_000)
REPORTED: Final = range(5_000_000, 6_000_000)

_LISTS = ("singles", "pairs", "triples", "novel", "clean", "missing_columns", "heavy")
_SHARE = 100_000

DESIGNS: Final = ("bfd", "sfdre", "bfdr", "bfdrt", "qfd", "bfdreEn")
"""Designs with at least two mounts swept, which most effects need to be told apart."""
ALL_DESIGNS: Final = ("sf", "bf", *DESIGNS)
RAMPS: Final = ("bfdrt", "bfdt", "qfdrt")
_WARM: Final = ("bias_temperature", "scale_temperature", "turning_point", "threshold_of_warmth")
_END: Final = ("k_zz", "k_xz", "k_yz", "axis_tilt")
LEFT_OUT: Final = (
    ("time_s",),
    ("realisation",),
    ("direction",),
    ("temperature_degC",),
    ("voltage_sd_V", "samples"),
    ("procedure",),
    ("time_s", "direction", "temperature_degC", "voltage_sd_V", "samples", "procedure"),
)


def _seed(seeds: range, which: str, number: int) -> int:
    return seeds[_LISTS.index(which) * _SHARE + number]


def designs_for(name: str) -> tuple[str, ...]:
    """Designs that vary what the effect depends on."""
    if name in _WARM:
        return RAMPS
    return ("sfdre", "bfdreEn", "sfdreEn") if name in _END else ALL_DESIGNS


def singles(seeds: range = DEVELOPMENT, visible: tuple[float, ...] = (12.0, 20.0, 40.0)) -> Wanted:
    """Every named effect alone, in every design that can show it, at each strength."""
    specs = [
        Spec(design=design, effects=((name, units),))
        for name in NAMED
        for design in designs_for(name)
        for units in visible
    ]
    return [(spec, _seed(seeds, "singles", number)) for number, spec in enumerate(specs)]


def _several(which: str, size: int, seeds: range, count: int, visible: float) -> Wanted:
    """Effects drawn without replacement among all sets of `size`, each in a design drawn among those good for all."""
    rng = np.random.default_rng(seeds.start + size)
    sets = list(combinations(NAMED, size))
    wanted: Wanted = []
    for number, index in enumerate(rng.choice(len(sets), count, replace=False)):
        names = sets[index]
        designs = set(DESIGNS if not set(names) & set(_WARM) else RAMPS)
        if set(names) & set(_END):
            designs = {"bfdreEnt"} if set(names) & set(_WARM) else {"bfdreEn", "sfdreEn"}
        design = sorted(designs)[rng.integers(len(designs))]
        spec = Spec(design=design, effects=tuple((name, visible) for name in names))
        wanted.append((spec, _seed(seeds, which, number)))
    return wanted


def pairs(seeds: range = DEVELOPMENT, count: int = 150, visible: float = 30.0) -> Wanted:
    """Two named effects at once."""
    return _several("pairs", 2, seeds, count, visible)


def triples(seeds: range = DEVELOPMENT, count: int = 100, visible: float = 40.0) -> Wanted:
    """Three named effects at once."""
    return _several("triples", 3, seeds, count, visible)


def novel(seeds: range = DEVELOPMENT, visible: tuple[float, ...] = (20.0, 40.0)) -> Wanted:
    """Every effect outside the catalogue alone, in several designs."""
    specs = [
        Spec(design=design, effects=((name, units),))
        for name in NOVEL
        for design in (RAMPS if name in _WARM else ("bf", "bfd", "bfdr", "sfdre", "bfdreEn"))
        for units in visible
    ]
    return [(spec, _seed(seeds, "novel", number)) for number, spec in enumerate(specs)]


def clean(
    seeds: range = DEVELOPMENT, count: int = 10_000, designs: tuple[str, ...] = ALL_DESIGNS, noise_v: float = 1e-4
) -> Wanted:
    """No effect at all, white noise, three to six realisations: for coverage and for false names."""
    specs = [
        Spec(design=designs[number % len(designs)], realisations=3 + number // len(designs) % 4, noise_v=noise_v)
        for number in range(count)
    ]
    return [(spec, _seed(seeds, "clean", number)) for number, spec in enumerate(specs)]


def missing_columns(seeds: range = DEVELOPMENT) -> Wanted:
    """Tables that do without optional columns, clean and with one effect."""
    specs = [
        Spec(design=design, effects=effects, left_out=left_out)
        for left_out in LEFT_OUT
        for design in ("bfd", "bfdr", "qfd")
        for effects in ((), (("k_xx", 30.0),), (("bias_drift", 30.0),), (("backlash", 30.0),))
    ]
    return [(spec, _seed(seeds, "missing_columns", number)) for number, spec in enumerate(specs)]


def heavy(seeds: range = DEVELOPMENT, count: int = 40) -> Wanted:
    """No effect, and noise that is not white and normal: heavy tails, contamination, flicker, a coarse instrument."""
    specs = [
        Spec(design=ALL_DESIGNS[number % len(ALL_DESIGNS)], noise=noise, quantum_v=quantum_v)
        for noise, quantum_v in (
            ("student", 0.0),
            ("contaminated", 0.0),
            ("flicker", 0.0),
            ("white", 1e-4),
            ("white", 3e-4),
        )
        for number in range(count)
    ]
    return [(spec, _seed(seeds, "heavy", number)) for number, spec in enumerate(specs)]
