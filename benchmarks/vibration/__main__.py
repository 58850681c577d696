"""Exactness, false alarms and coverage of the closed loop on simulated dwells under vibration.

`python -m benchmarks.vibration LIST --seeds reported --tables 100`, LIST one of clean, single, pairs, novel.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np

from benchmarks.vibration.designs import DESIGNS
from benchmarks.vibration.effects import CATALOGUE, NOT_SHOWN, NOVEL
from benchmarks.vibration.world import Effect, Made, make
from tumble.calibrations.methods.vibration.loop import VibrationLoop, close_vibration_loop
from tumble.calibrations.methods.vibration.model import NAMES
from tumble.calibrations.methods.vibration.observations import read_vibration_table
from tumble.calibrations.methods.vibration.table import vibration_table

SEEDS = {"development": 1_000_000, "reported": 8_200_000}
UNITS = (20.0, 30.0, 40.0)
_TRIED = 60


@click.command()
@click.argument("kind", type=click.Choice(["clean", "single", "pairs", "novel"]))
@click.option("--seeds", type=click.Choice([*SEEDS]), default="development")
@click.option("--tables", default=30)
@click.option("--first", default=0)
@click.option("--verbose", is_flag=True)
def main(kind: str, seeds: str, tables: int, first: int, *, verbose: bool) -> None:
    """Run one list."""
    right = inside = stated = 0
    by_name: Counter[str] = Counter()
    for number in range(first, first + tables):
        names, made, where = drawn(kind, SEEDS[seeds] + number)
        loop = closed(made)
        good = is_right(loop, kind, names)
        right += good
        by_name.update(name for name in names if not good)
        within, told = _inside(loop, made)
        inside, stated = inside + within, stated + told
        if verbose and not good:
            print(number, where, names, "->", _said(loop))
    print(f"{kind}: {right} of {tables} right; {inside} of {stated} stated coefficients inside their intervals")
    print("not right:", dict(by_name))


def drawn(kind: str, seed: int) -> tuple[tuple[str, ...], Made, str]:
    """Names of the effects, the table, and the programme; effects that a programme cannot show are drawn again."""
    rng = np.random.default_rng(seed)
    for _ in range(_TRIED):
        where = DESIGNS[int(rng.integers(len(DESIGNS)))]
        if kind == "clean":
            return (), make(seed, where, {}), where
        if kind == "novel":
            names: tuple[str, ...] = (list(NOVEL)[int(rng.integers(len(NOVEL)))],)
        else:
            chosen = rng.choice(len(CATALOGUE), size=1 if kind == "single" else 2, replace=False)
            names = tuple(list(CATALOGUE)[place] for place in chosen.tolist())
        known = {**CATALOGUE, **{name: each[:2] for name, each in NOVEL.items()}}
        if where in NOT_SHOWN.get(names[0], ()):
            continue
        sized = {name: _sized(seed, where, name, known[name], float(rng.choice(UNITS))) for name in names}
        if all(sized.values()):
            effects: Mapping[str, tuple[Effect, float]] = {name: each for name, each in sized.items() if each}
            return names, make(seed, where, effects), where
    raise AssertionError("no programme shows it")


def _sized(seed: int, where: str, name: str, effect: tuple[Effect, float], units: float) -> tuple[Effect, float] | None:
    """An effect as large as it is visible by so many noise units; None where nothing is seen of it."""
    change, size = effect
    for _ in range(8):
        shown = visible(make(seed, where, {name: (change, size)}))
        if not shown > 1e-3:
            return None
        if abs(shown / units - 1.0) < 0.02:
            break
        size *= min(max(units / shown, 0.05), 20.0) ** (0.67 if name == "clipping" else 1.0)
    reasonable = {"shaker_cross": 0.5, "frequency_response": 0.7, "clipping": 0.5, "partial_periods": 3.0}
    few = _rows_that_show(make(seed, where, {name: (change, size)})) < 6
    return (
        (change, size) if size < reasonable.get(name, np.inf) and abs(shown / units - 1.0) < 0.2 and not few else None
    )


def _rows_that_show(made: Made) -> int:
    """Rows that hold nine tenths of the square of what is visible."""
    square = np.sort(_left(made) ** 2)[::-1]
    return int(np.searchsorted(np.cumsum(square), 0.9 * square.sum())) + 1


def visible(made: Made) -> float:
    """Length of what effects add beside the declared model, in standard deviations of a dwell."""
    return float(np.linalg.norm(_left(made)))


def _left(made: Made):  # type: ignore[no-untyped-def]
    table = vibration_table(*(2 * [read(made)]))
    white = made.effect_ug / made.noise_ug
    columns = table.declared / made.noise_ug[:, None]
    return white - columns @ np.linalg.lstsq(columns, white, rcond=1e-9)[0]


def read(made: Made):  # type: ignore[no-untyped-def]
    """The table as a file, which is all that the analysis sees."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "table.csv"
        columns = made.columns
        lines = [",".join(columns)]
        lines += [",".join(map(str, row)) for row in zip(*columns.values(), strict=True)]
        path.write_text("\n".join(lines).replace("nan", "") + "\n", encoding="utf-8")
        return read_vibration_table(path)


def closed(made: Made) -> VibrationLoop:
    """The loop closed on a table."""
    return close_vibration_loop(read(made))


def is_right(loop: VibrationLoop, kind: str, names: Sequence[str]) -> bool:
    """Whether exactly what is there was found; of near rivals, that the true one is among them."""
    if kind == "novel":
        if loop.unexplained is None or loop.effects:
            return False
        said = {str(loop.unexplained.depends_on), *(variable for _, variable in loop.unexplained.also_possible)}
        return not said.isdisjoint(NOVEL[names[0]][2])
    if loop.unexplained is not None or len(loop.effects) != len(names):
        return False
    among = [{str(effect.name), *map(str, effect.also_possible)} for effect in loop.effects]
    return all(any(name in each for each in among) for name in names)


def _said(loop: VibrationLoop) -> str:
    found = {str(effect.name): [*map(str, effect.also_possible)] for effect in loop.effects}
    left = loop.unexplained and f"{loop.unexplained.depends_on}: {loop.unexplained.description}"
    aside = len(loop.observations.set_aside)
    return f"{found} unexplained {left} withheld {[str(each.name) for each in loop.withheld]} aside {aside}"


def _inside(loop: VibrationLoop, made: Made) -> tuple[int, int]:
    truth = dict(zip(NAMES, made.coefficients.tolist(), strict=True))
    inside = told = 0
    for name, parameter in loop.augmented.parameters.items():
        if parameter.interval_95 is not None:
            told += 1
            value = sum(truth[each] for each in name.split("+"))
            inside += parameter.interval_95[0] <= value <= parameter.interval_95[1]
    return inside, told


if __name__ == "__main__":
    main()
