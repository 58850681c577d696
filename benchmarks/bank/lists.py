"""What the bank consists of: lists of (spec, seed), each with seeds of its own.

The seeds are fixed beforehand. Those of `DEVELOPMENT` may be looked at while an analysis is written; those of
`REPORTED` are run once, for the numbers that are published; seven earlier sets, from 5,000,000 to 11,000,000 on, were
given up when they had brought faults of the analysis to light. No seed is in both, nor in two lists.
"""

from itertools import combinations
from typing import Final

import numpy as np

from benchmarks.bank.beyond import BEYOND
from benchmarks.bank.catalogue import NAMED
from benchmarks.bank.novel import NOVEL
from benchmarks.bank.table import Spec

Wanted = list[tuple[Spec, int]]

DEVELOPMENT: Final = range(1_000_000, 2_000_000)
REPORTED: Final = range(12_000_000, 13_000_000)

_LISTS = ("singles", "pairs", "triples", "novel", "clean", "missing_columns", "heavy", "mixture", "power", "beyond")
_SHARE = 100_000

DESIGNS: Final = ("bfd", "sfdre", "bfdr", "bfdrt", "qfd", "bfdreEn")
"""Designs with at least two mounts swept, which most effects need to be told apart."""
ALL_DESIGNS: Final = ("sf", "bf", *DESIGNS)
RAMPS: Final = ("bfdrt", "bfdt", "qfdrt")
_WARM: Final = ("bias_temperature", "scale_temperature", "turning_point", "threshold_of_warmth")
_BEYOND_DESIGNS: Final = ("bf", "bfdr", "qfd", "sfdre")
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


def designs_for_all(names: tuple[str, ...]) -> list[str]:
    """Designs that vary what several effects depend on and sweep at least two mounts."""
    if set(names) & set(_END):
        return ["bfdreEnt"] if set(names) & set(_WARM) else ["bfdreEn", "sfdreEn"]
    return sorted(RAMPS if set(names) & set(_WARM) else DESIGNS)


def _several(which: str, size: int, seeds: range, count: int, visible: float) -> Wanted:
    """Effects drawn without replacement among all sets of `size`, each in a design drawn among those good for all."""
    rng = np.random.default_rng(seeds.start + size)
    sets = list(combinations(NAMED, size))
    wanted: Wanted = []
    for number, index in enumerate(rng.choice(len(sets), count, replace=False)):
        names = sets[index]
        designs = designs_for_all(names)
        design = designs[rng.integers(len(designs))]
        spec = Spec(design=design, effects=tuple((name, visible) for name in names))
        wanted.append((spec, _seed(seeds, which, number)))
    return wanted


def pairs(seeds: range = DEVELOPMENT, count: int = 150, visible: float = 30.0) -> Wanted:
    """Two named effects at once."""
    return _several("pairs", 2, seeds, count, visible)


def triples(seeds: range = DEVELOPMENT, count: int = 100, visible: float = 40.0) -> Wanted:
    """Three named effects at once."""
    return _several("triples", 3, seeds, count, visible)


def _designs_for_novel(name: str) -> tuple[str, ...]:
    return RAMPS if name in _WARM else ("bf", "bfd", "bfdr", "sfdre", "bfdreEn")


def novel(seeds: range = DEVELOPMENT, visible: tuple[float, ...] = (20.0, 40.0)) -> Wanted:
    """Every effect outside the catalogue alone, in several designs."""
    specs = [
        Spec(design=design, effects=((name, units),))
        for name in NOVEL
        for design in _designs_for_novel(name)
        for units in visible
    ]
    return [(spec, _seed(seeds, "novel", number)) for number, spec in enumerate(specs)]


def beyond(seeds: range = DEVELOPMENT, visible: tuple[float, ...] = (12.0, 20.0, 40.0)) -> Wanted:
    """Every effect of the second set outside the catalogue alone, in several designs."""
    specs = [
        Spec(design=design, effects=((name, units),))
        for name, (on, _, _) in BEYOND.items()
        for design in (RAMPS if on == "temperature" else _BEYOND_DESIGNS)
        for units in visible
    ]
    return [(spec, _seed(seeds, "beyond", number)) for number, spec in enumerate(specs)]


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


def mixture(seeds: range = DEVELOPMENT, count: int = 10_000) -> Wanted:
    """What a laboratory may meet: of twelve tables four clean, four with one effect, three with two, one with more.

    That one holds three effects or a novel one by turns. Clean tables have white noise, Student's or flicker, the
    others white. Every table is drawn from its own seed, so that a longer list begins as a shorter one does.
    """
    wanted: Wanted = []
    for number in range(count):
        seed = _seed(seeds, "mixture", number)
        wanted.append((_mixed(number, np.random.default_rng((seed, _MIXING))), seed))
    return wanted


_MIXING: Final = 1000
"""Part of a seed from which the spec of a mixed table is drawn; the table itself draws from smaller parts."""


def _mixed(number: int, rng: np.random.Generator) -> Spec:
    turn, place = divmod(number, 12)
    realisations = int(rng.integers(2, 5))
    if place < 4:
        noise = ("white", "student", "flicker")[rng.integers(3)]
        return Spec(design=_one_of(ALL_DESIGNS, rng), realisations=realisations, noise=noise)
    if place < 8:
        name = _one_of(NAMED, rng)
        return _shown(_one_of(designs_for(name), rng), realisations, (name,), (12.0, 20.0, 40.0)[rng.integers(3)])
    if place == 11 and turn % 2:
        name = _one_of(tuple(NOVEL), rng)
        return _shown(_one_of(_designs_for_novel(name), rng), realisations, (name,), (20.0, 40.0)[rng.integers(2)])
    size, visible = (3, 40.0) if place == 11 else (2, 30.0)
    names = tuple(NAMED[index] for index in np.sort(rng.choice(len(NAMED), size, replace=False)))
    return _shown(_one_of(tuple(designs_for_all(names)), rng), realisations, names, visible)


def _shown(design: str, realisations: int, names: tuple[str, ...], visible: float) -> Spec:
    return Spec(design=design, realisations=realisations, effects=tuple((name, visible) for name in names))


def _one_of(words: tuple[str, ...], rng: np.random.Generator) -> str:
    return words[rng.integers(len(words))]


_POWER_EFFECTS: Final = ("k_xx", "bias_drift", "backlash", "graduation", "daq_nonlinearity")
"""One of each kind: a product of projections, a drift, a play, a harmonic of unknown order, a wave of the voltage."""
_POWER_SIGNALS: Final = (2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0)


def power(seeds: range = DEVELOPMENT, count: int = 100) -> Wanted:
    """A few effects alone, from invisible to plain, `count` tables each; a longer list begins as a shorter one does."""
    specs = [
        Spec(design="bfd", effects=((name, units),))
        for _ in range(count)
        for name in _POWER_EFFECTS
        for units in _POWER_SIGNALS
    ]
    return [(spec, _seed(seeds, "power", number)) for number, spec in enumerate(specs)]
