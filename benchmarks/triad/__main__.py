"""Exactness, false alarms and coverage of the closed loop on simulated triads.

`python -m benchmarks.triad LIST --seeds reported --tables 100`, LIST one of clean, single, pairs, novel, alike.

Effects are sized by what of them the declared model leaves. Forms of `novel` are sized by what the nearest one or two
effects of the catalogue leave of them, so that they differ from it in these rows; those of `alike` as effects are, so
that the catalogue may have them as well, and then it is right to name it.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np

from benchmarks.triad.apart import NOT_PARTED, Seen
from benchmarks.triad.effects import STAND, UNIT
from benchmarks.triad.novel import NOVEL_STAND, NOVEL_UNIT
from benchmarks.triad.world import Array, Made, Stand, Unit, make
from tumble.calibrations.methods.triad.geometry import directions
from tumble.calibrations.methods.triad.loop import TriadLoop, close_triad_loop
from tumble.calibrations.methods.triad.model import NAMES, Triad, functions
from tumble.calibrations.methods.triad.observations import read_triad_table
from tumble.calibrations.methods.triad.programmes import POSITIONS

SEEDS = {"development": 1_000, "reported": 7_200_000}
NOISE_V = ((1e-5, 1e-5, 1e-5), (1.6e-5, 1e-5, 2.5e-5))
UNITS = (20.0, 30.0, 40.0)
UNITS_APART = (12.0, 20.0, 30.0)
LARGEST_V = 5e-3
"""No form is made larger to differ from the catalogue; another one is drawn then."""
_ALL = (*UNIT, *STAND)


@dataclass(frozen=True)
class Drawn:
    """A table, and what is to be found in it."""

    names: Sequence[str]
    made: Made
    variables: frozenset[str] = frozenset()
    """Those along which a form without a name may be said to be; none where there is none."""
    has_a_name: bool = False
    """Whether one or two effects of the catalogue leave nothing to see of that form."""


@click.command()
@click.argument("kind", type=click.Choice(["clean", "single", "pairs", "novel", "alike"]))
@click.option("--seeds", type=click.Choice([*SEEDS]), default="development")
@click.option("--tables", default=30)
@click.option("--first", default=0)
@click.option("--verbose", is_flag=True)
def main(kind: str, seeds: str, tables: int, first: int, *, verbose: bool) -> None:
    """Run one list."""
    counted: Counter[str] = Counter()
    for number in range(first, first + tables):
        drawn = _drawn(kind, number, np.random.default_rng([SEEDS[seeds], number]))
        loop = _closed(drawn.made)
        right = _right(loop, drawn)
        counted["right"] += right
        counted.update(_inside(loop, drawn.made))
        if drawn.variables:
            counted["unexplained"] += loop.unexplained is not None and right
            counted["has a name"] += drawn.has_a_name
        if verbose and not right:
            _tell(number, loop, drawn)
    print(
        f"{kind}: {counted['right']} of {tables} right; "
        f"{counted['inside']} of {counted['stated']} stated parameters inside their intervals"
    )
    if kind in ("novel", "alike"):
        print(f"unexplained {counted['unexplained']}; of {counted['has a name']} the catalogue leaves nothing to see")


def _tell(number: int, loop: TriadLoop, drawn: Drawn) -> None:
    said = {effect.name: effect.also_possible for effect in loop.effects}
    unexplained = loop.unexplained and (loop.unexplained.depends_on, loop.unexplained.description)
    print(number, *drawn.names, sorted(drawn.variables), "->", said, unexplained, flush=True)


def _drawn(kind: str, number: int, rng: np.random.Generator) -> Drawn:
    """A table of a list."""
    if kind in ("novel", "alike"):
        return _without_name(number, rng, apart=kind == "novel")
    positions, noise = POSITIONS["24" if number % 3 else "18"], NOISE_V[number % 2]
    if kind == "clean":
        return Drawn((), make(rng, positions, int(rng.integers(1, 4)), noise))
    pairs = list(combinations(_ALL, 2))
    names = (_ALL[number % len(_ALL)],) if kind == "single" else pairs[int(rng.integers(len(pairs)))]
    return Drawn(names, _sized(rng, positions, noise, {name: {**UNIT, **STAND}[name] for name in names}))


def _without_name(number: int, rng: np.random.Generator, *, apart: bool) -> Drawn:
    """A table with a form that no catalogue names; every second one has positions off the 45° grid too."""
    novel = {**NOVEL_UNIT, **NOVEL_STAND}
    while True:
        name = list(novel)[number % len(novel)]
        draw, true = novel[name]
        positions = POSITIONS[("24", "18")[int(rng.integers(2))]]
        positions = (*positions, *POSITIONS["fine"]) if (number // len(novel)) % 2 else positions
        form, noise, seed = draw(rng), NOISE_V[int(rng.integers(2))], int(rng.integers(2**31))
        trial = _made(seed, positions, noise, {name: (form, _trial(name))})
        shown = Seen(trial).left_by_two() if apart else _visible(trial)
        units = float(rng.choice(UNITS_APART if apart else UNITS))
        size = _trial(name) * units / max(shown, 1e-9)
        made = _made(seed, positions, noise, {name: (form, size)})
        if np.abs(made.effect_v).max() <= LARGEST_V:
            seen = Seen(made)
            return Drawn((name,), made, seen.variables(true), seen.left_by_two() < NOT_PARTED)
        number += 1


def _trial(name: str) -> float:
    """A size that is small: arc seconds of the stand, volts of the unit."""
    return 10.0 if name in STAND or name in NOVEL_STAND else 1e-4


def _sized(
    rng: np.random.Generator,
    positions: Sequence[tuple[float, float]],
    noise: Sequence[float],
    effects: dict[str, Unit | Stand],
) -> Made:
    """A table in which each effect is visible by so many noise units."""
    seed, sizes = int(rng.integers(2**31)), {}
    for name, effect in effects.items():
        alone = _made(seed, positions, noise, {name: (effect, _trial(name))})
        sizes[name] = _trial(name) * float(rng.choice(UNITS)) / _visible(alone)
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


def _right(loop: TriadLoop, drawn: Drawn) -> bool:
    """Whether exactly what is there was found; of near rivals, that the true one is among them."""
    if drawn.variables:
        if loop.unexplained is None:
            return drawn.has_a_name and bool(loop.effects)
        return loop.unexplained.depends_on in drawn.variables and not loop.effects
    if loop.unexplained is not None or len(loop.effects) != len(drawn.names):
        return False
    among = [{effect.name, *effect.also_possible} for effect in loop.effects]
    return all(any(name in each for each in among) for name in drawn.names)


def _inside(loop: TriadLoop, made: Made) -> dict[str, int]:
    parameters, truth = loop.augmented.parameters, made.triad.stated
    intervals = [(parameters[name].interval_95, truth[name]) for name in NAMES]
    known = [(interval, value) for interval, value in intervals if interval is not None]
    return {"inside": sum(low <= value <= high for (low, high), value in known), "stated": len(known)}


if __name__ == "__main__":
    main()
