"""Exactness, false alarms and coverage of the closed loop on simulated platforms.

`python -m benchmarks.gyrocompass LIST --seeds reported --tables 100`, LIST one of clean, single, pairs, novel.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np

from benchmarks.gyrocompass.effects import NOVEL, NOVEL_STAND, STAND, UNIT
from benchmarks.gyrocompass.world import Array, Design, Made, make
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop, close_gyrocompass_loop
from tumble.calibrations.methods.gyrocompass.observations import read_gyrocompass_table

SEEDS = {"development": 1_000, "reported": 8_200_000}
_TWELVE = tuple(float(angle) for angle in range(0, 360, 30))
_FOUR = (0.0, 90.0, 180.0, 270.0)
DESIGNS = (
    Design(angles_deg=_FOUR, passes=5),
    Design(angles_deg=_TWELVE, passes=3),
    Design(angles_deg=_FOUR, passes=5, bases=3, lean_deg=3.0),
    Design(angles_deg=tuple(float(angle) for angle in range(0, 360, 45)), passes=4),
    Design(angles_deg=_TWELVE, passes=2, bases=2, lean_deg=2.0),
)
MANY = (DESIGNS[1], DESIGNS[3])
"""Designs in which structure without a name can be told."""
FAR = 2.2
UNITS = (20.0, 30.0, 40.0)
_ALL = (*UNIT, *STAND)
_IN_TILTS = ("tilt_bias",)
_SMALL_TILT_BIAS_DEG = 5e-4


@click.command()
@click.argument("kind", type=click.Choice(["clean", "single", "pairs", "novel"]))
@click.option("--seeds", type=click.Choice([*SEEDS]), default="development")
@click.option("--tables", default=30)
@click.option("--first", default=0)
@click.option("--verbose", is_flag=True)
def main(kind: str, seeds: str, tables: int, first: int, *, verbose: bool) -> None:
    """Run one list."""
    counted: Counter[str] = Counter()
    for number in range(first, first + tables):
        rng = np.random.default_rng([SEEDS[seeds], number])
        names, wanted, made = _drawn(kind, number, rng)
        loop = closed(made.columns)
        right = _right(loop, names, wanted)
        counted["right"] += right
        counted.update(_inside(loop, made))
        if verbose and not right:
            _tell(number, loop, names)
        if verbose:
            _tell_outside(number, loop, made, names)
    print(
        f"{kind}: {counted['right']} of {tables} right; {counted['inside']} of {counted['stated']} stated parameters "
        f"inside their intervals, {counted['withheld']} withheld"
    )


def _tell(number: int, loop: GyrocompassLoop, names: Sequence[str]) -> None:
    said = {effect.name: effect.also_possible for effect in loop.effects}
    unexplained = loop.unexplained and (loop.unexplained.depends_on, loop.unexplained.description)
    print(number, names, "->", said, unexplained, [(each.name, each.reason) for each in loop.withheld])


def _tell_outside(number: int, loop: GyrocompassLoop, made: Made, names: Sequence[str]) -> None:
    truth = {"alpha0": made.platform.alpha0_deg, "drift": made.drift_deg_h}
    for name, parameter in loop.augmented.parameters.items():
        if parameter.value is not None and parameter.standard_uncertainty:
            off = ((parameter.value - truth[name] + 180.0) % 360.0 - 180.0) / parameter.standard_uncertainty
            if abs(off) > FAR:
                print(
                    f"{number} {names} {name} off by {off:.1f} standard uncertainties", [e.name for e in loop.effects]
                )


def _drawn(kind: str, number: int, rng: np.random.Generator) -> tuple[Sequence[str], str, Made]:
    """Names of the effects, the variable of a kind without a name, and the table."""
    if kind == "clean":
        return (), "", make(rng, DESIGNS[number % len(DESIGNS)])
    if kind == "novel":
        novel = {**NOVEL, **NOVEL_STAND}
        name = list(novel)[number % len(novel)]
        return (name,), novel[name][1], _sized(rng, MANY[(number // len(novel)) % len(MANY)], (name,))
    pairs = list(combinations(_ALL, 2))
    names = (_ALL[number % len(_ALL)],) if kind == "single" else pairs[int(rng.integers(len(pairs)))]
    return names, "", _sized(rng, DESIGNS[int(rng.integers(len(DESIGNS)))], names)


def _sized(rng: np.random.Generator, design: Design, names: Sequence[str]) -> Made:
    """A table in which each effect is visible by so many noise units."""
    seed, sizes = int(rng.integers(2**31)), {}
    for name in names:
        units = float(rng.choice(UNITS))
        if name in _IN_TILTS:
            sizes[name] = _SMALL_TILT_BIAS_DEG * units / UNITS[0]
            continue
        size = 0.1
        for _ in range(3):
            size *= units / max(_visible(_made(seed, design, {name: size})), 1e-9)
            size = min(size, 1e3)
        sizes[name] = size
    return _made(seed, design, sizes)


def _made(seed: int, design: Design, sizes: Mapping[str, float]) -> Made:
    stands = {**STAND, **{name: each for name, (each, _) in NOVEL_STAND.items()}}
    units = {**UNIT, **{name: each for name, (each, _) in NOVEL.items()}}
    warm = 3.0 if any("temperature" in name or "thermal" in name for name in sizes) else 0.0
    return make(
        np.random.default_rng(seed),
        design,
        [(stands[name], size) for name, size in sizes.items() if name in stands],
        [(units[name], size) for name, size in sizes.items() if name in units],
        warm,
        reported=1.0 + sizes.get("torquer_scale", 0.0),
    )


def _visible(made: Made) -> float:
    """Length of what effects add beside heading and drift, in standard deviations of a dwell."""
    delta, bases = np.deg2rad(made.columns["azimuth_deg"]), made.columns["base"]
    turned = np.zeros(len(delta))
    for base in np.unique(bases):
        its = bases == base
        wave = np.column_stack([np.cos(delta[its]), np.sin(delta[its]), np.ones(its.sum())])
        amplitude = np.linalg.lstsq(wave, made.clean_deg_h[its], rcond=None)[0]
        turned[its] = -amplitude[0] * np.sin(delta[its]) + amplitude[1] * np.cos(delta[its])
    jacobian = np.column_stack([turned, np.ones(len(delta))])
    left = made.effect_deg_h - jacobian @ np.linalg.lstsq(jacobian, made.effect_deg_h, rcond=None)[0]
    return float(np.linalg.norm(left) / made.noise_deg_h)


def closed(columns: Mapping[str, Array]) -> GyrocompassLoop:
    """The loop closed on a table as a file, which is all that the analysis sees."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "table.csv"
        write(path, columns)
        return close_gyrocompass_loop(read_gyrocompass_table(path))


def write(path: Path, columns: Mapping[str, Array]) -> None:
    """Write a table, with the digits that such a platform reports."""
    rows = zip(*columns.values(), strict=True)
    lines = [
        ",".join(columns),
        *(",".join(_cell(name, value) for name, value in zip(columns, row, strict=True)) for row in rows),
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _cell(name: str, value: float) -> str:
    return f"{value:.6f}" if name in ("rate_deg_h", "tilt_gamma_deg") else f"{value:.6g}"


def _right(loop: GyrocompassLoop, names: Sequence[str], wanted: str) -> bool:
    """Whether exactly what is there was found; of rivals that are not told apart, that the true one is among them."""
    if wanted:
        if loop.unexplained is None or loop.effects:
            return False
        said = {loop.unexplained.depends_on, *(variable for _, variable in loop.unexplained.also_possible)}
        return wanted in said
    if loop.unexplained is not None or len(loop.effects) != len(names):
        return False
    among = [{effect.name, *effect.also_possible} for effect in loop.effects]
    return all(any(name in each for each in among) for name in names)


def _inside(loop: GyrocompassLoop, made: Made) -> dict[str, int]:
    """How many stated parameters hold the truth in their intervals."""
    truth = {"alpha0": made.platform.alpha0_deg, "drift": made.drift_deg_h}
    counted = {"inside": 0, "stated": 0, "withheld": 0}
    for name, parameter in loop.augmented.parameters.items():
        if parameter.interval_95 is None or parameter.value is None:
            counted["withheld"] += 1
            continue
        low, high = parameter.interval_95
        off = (truth[name] - parameter.value + 180.0) % 360.0 - 180.0
        counted["stated"] += 1
        counted["inside"] += low - parameter.value <= off <= high - parameter.value
    return counted


if __name__ == "__main__":
    main()
