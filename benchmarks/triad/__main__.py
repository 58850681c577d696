"""Exactness, false alarms and coverage of the closed loop on simulated triads.

`python -m benchmarks.triad LIST --seeds reported --tables 100`, LIST one of clean, single, pairs, novel.
"""

from collections import Counter
from collections.abc import Sequence
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np

from benchmarks.triad.effects import NOVEL_STAND, NOVEL_UNIT, STAND, UNIT
from benchmarks.triad.world import Array, Made, Stand, Unit, make
from tumble.calibrations.methods.triad.geometry import directions
from tumble.calibrations.methods.triad.loop import TriadLoop, close_triad_loop
from tumble.calibrations.methods.triad.model import NAMES, Triad, functions
from tumble.calibrations.methods.triad.observations import read_triad_table
from tumble.calibrations.methods.triad.programmes import POSITIONS

SEEDS = {"development": 1_000, "reported": 7_000_000}
NOISE_V = ((1e-5, 1e-5, 1e-5), (1.6e-5, 1e-5, 2.5e-5))
UNITS = (20.0, 30.0, 40.0)
_ALL = (*UNIT, *STAND)


@click.command()
@click.argument("kind", type=click.Choice(["clean", "single", "pairs", "novel"]))
@click.option("--seeds", type=click.Choice([*SEEDS]), default="development")
@click.option("--tables", default=30)
@click.option("--fine", is_flag=True, help="Positions in steps of 15° beside those of 45°.")
@click.option("--verbose", is_flag=True)
def main(kind: str, seeds: str, tables: int, *, fine: bool, verbose: bool) -> None:
    """Run one list."""
    counted: Counter[str] = Counter()
    inside = stated = 0
    for number in range(tables):
        rng = np.random.default_rng([SEEDS[seeds], number])
        names, wanted, made = _drawn(kind, number, rng, POSITIONS["fine"] if fine else ())
        loop = _closed(made)
        said = sorted(effect.name for effect in loop.effects)
        right = _right(loop, said, names, wanted)
        counted["right"] += right
        within, number_stated = _inside(loop, made)
        inside, stated = inside + within, stated + number_stated
        if verbose and not right:
            unexplained = loop.unexplained and loop.unexplained.description
            also = {effect.name: effect.also_possible for effect in loop.effects if effect.also_possible}
            print(number, names, "->", said, unexplained, also, [each.name for each in loop.withheld])
    print(
        f"{kind}: {counted['right']} of {tables} right; {inside} of {stated} stated parameters inside their intervals"
    )


def _drawn(
    kind: str, number: int, rng: np.random.Generator, beside: Sequence[tuple[float, float]] = ()
) -> tuple[Sequence[str], str, Made]:
    """Names of the effects, the variable of a kind without a name, and the table."""
    positions = (*POSITIONS["24" if number % 3 else "18"], *beside)
    noise = NOISE_V[number % 2]
    if kind == "clean":
        return (), "", make(rng, positions, int(rng.integers(1, 4)), noise)
    if kind == "novel":
        novel = {**NOVEL_UNIT, **NOVEL_STAND}
        name = list(novel)[number % len(novel)]
        effects = {name: novel[name][0]}
        return (name,), novel[name][1], _sized(rng, positions, noise, effects)
    pairs = list(combinations(_ALL, 2))
    names = (_ALL[number % len(_ALL)],) if kind == "single" else pairs[int(rng.integers(len(pairs)))]
    return names, "", _sized(rng, positions, noise, {name: {**UNIT, **STAND}[name] for name in names})


def _sized(
    rng: np.random.Generator,
    positions: Sequence[tuple[float, float]],
    noise: Sequence[float],
    effects: dict[str, Unit | Stand],
) -> Made:
    """A table in which each effect is visible by so many noise units."""
    seed, sizes = int(rng.integers(2**31)), {}
    for name, effect in effects.items():
        trial = 10.0 if name in STAND or name in NOVEL_STAND else 1e-4
        alone = _made(seed, positions, noise, {name: (effect, trial)})
        sizes[name] = trial * float(rng.choice(UNITS)) / _visible(alone)
    return _made(seed, positions, noise, {name: (effects[name], sizes[name]) for name in effects})


def _made(
    seed: int,
    positions: Sequence[tuple[float, float]],
    noise: Sequence[float],
    effects: dict[str, tuple[Unit | Stand, float]],
) -> Made:
    stand = [each for name, each in effects.items() if name in STAND or name in NOVEL_STAND]
    unit = [each for name, each in effects.items() if name in UNIT or name in NOVEL_UNIT]
    return make(np.random.default_rng(seed), positions, 3, noise, stand, unit)  # type: ignore[arg-type]


def _visible(made: Made) -> float:
    """Length of what effects add beside the declared model, in standard deviations of a dwell."""
    white = (made.effect_v / made.noise_v).ravel()
    shown = functions(directions(made.columns["outer_deg"], made.columns["inner_deg"]))
    theta = np.concatenate([np.zeros(3), np.eye(3).ravel(), np.zeros(2)])
    jacobian = shown @ Triad(functions=shown).slopes(theta)
    jacobian /= np.tile(made.noise_v, len(made.effect_v))[:, None]
    return float(np.linalg.norm(white - jacobian @ np.linalg.lstsq(jacobian, white, rcond=None)[0]))


def _closed(made: Made) -> TriadLoop:
    """The loop closed on the table as a file, which is all that the analysis sees."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "table.csv"
        write(path, made.columns)
        return close_triad_loop(read_triad_table(path))


def write(path: Path, columns: dict[str, Array] | object) -> None:
    """Write a table, with the digits that a voltmeter has."""
    assert isinstance(columns, dict)
    lines = [",".join(columns)]
    lines += [",".join(_cell(name, value) for name, value in zip(columns, row, strict=True))
              for row in zip(*columns.values(), strict=True)]  # fmt: skip
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _cell(name: str, value: float) -> str:
    return f"{value:.8f}" if name.startswith("u_") else f"{value:.4e}" if name.startswith("sd_") else f"{value:.6g}"


def _right(loop: TriadLoop, said: list[str], names: Sequence[str], wanted: str) -> bool:
    """Whether exactly what is there was found; of near rivals, that the true one is among them."""
    if wanted:
        return loop.unexplained is not None and loop.unexplained.depends_on == wanted and not said
    if loop.unexplained is not None or len(said) != len(names):
        return False
    among = [{effect.name, *effect.also_possible} for effect in loop.effects]
    return all(any(name in each for each in among) for name in names)


def _inside(loop: TriadLoop, made: Made) -> tuple[int, int]:
    parameters, truth = loop.augmented.parameters, made.triad.stated
    intervals = [(parameters[name].interval_95, truth[name]) for name in NAMES]
    known = [(interval, value) for interval, value in intervals if interval is not None]
    return sum(low <= value <= high for (low, high), value in known), len(known)


if __name__ == "__main__":
    main()
