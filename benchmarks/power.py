"""From which signal on `close_loop` sees an effect, beside the exact F test that knows what to look for.

    python -m benchmarks.power [--seeds development|reported] [--count N] [--out docs/power.png]

Signals are what the declared model cannot absorb, in units of the noise of a dwell. The F test is told the effect in
the form in which the table was made, every value in it but the amplitude; it has one degree of freedom in the numerator
and asks for as much as the tracer asks of each form of that effect. The tracer knows neither effect nor form. Its
effects count where the true one is a name or among `also_possible`. Told of counts, too, what is a warning and no
effect (`bias_drift`: "the bias wanders (drift, walk or flicker)"), beside the F test at the chance of that warning.

With `--results` every graded table becomes a line of that file at once, and a run that was interrupted continues.
"""

import argparse
import json
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import asdict
from multiprocessing import get_context
from pathlib import Path
from typing import Any, Final

os.environ["OMP_NUM_THREADS"] = "1"
os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.special import fdtri, ncfdtr

from benchmarks.bank import DEVELOPMENT, REPORTED, Spec, Stage, make_stage, make_table, power
from benchmarks.bank.scene import respond
from benchmarks.bank.visibility import sight
from benchmarks.loop.intervals import wilson
from benchmarks.loop.results import read_results, streamed
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.loop.scatter import CHANCE
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.model import PARAMETERS
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.report.figure import COLOURS, INK
from tumble.calibrations.tracing.candidates import candidates
from tumble.calibrations.tracing.penalties import FALSE_ALARM

_SEEDS: Final = {"development": DEVELOPMENT, "reported": REPORTED}
_PARTS: Final = (1.01, 0.99)
"""Parts of the true amplitude between which an effect is linearised."""
_TOLD: Final = {"bias_drift": "the bias wanders (drift"}
"""What a warning says of an effect that has no name yet."""
HALF = 0.5
"""From this power of the F test on a shortfall is looked for."""

Record = dict[str, Any]
Wanted = tuple[Spec, int]


def f_test_power(visible: float, chance: float, spare: int) -> float:
    """Chance that an F test with 1 and `spare` degrees of freedom sees a signal of this size.

    The noncentrality is `visible` squared; `chance` is that of a false alarm.
    """
    return 1.0 - float(ncfdtr(1.0, spare, visible**2, float(fdtri(1.0, spare, 1.0 - chance))))


def oracle_column(stage: Stage) -> FloatArray:
    """What the only effect of a table adds that the declared model cannot absorb, linearised at the truth, in volts."""
    ((effect, amplitude),) = stage.sized
    more, less = (respond(stage.run, stage.unit, ((effect, part * amplitude),)) for part in _PARTS)
    return _beside(sight(stage.run, stage.unit).tangent, (more - less) / (_PARTS[0] - _PARTS[1]))


def oracle_sees(stage: Stage, reading_v: FloatArray, chance: float) -> bool:
    """Whether the F test sees the effect in these readings."""
    known = sight(stage.run, stage.unit)
    column, left_v = oracle_column(stage), _beside(known.tangent, reading_v - known.plain_v)
    explained = (column @ left_v) ** 2 / (column @ column)
    spare = len(left_v) - len(PARAMETERS) - 1
    statistic = explained / ((left_v @ left_v - explained) / spare)
    return bool(statistic > fdtri(1.0, spare, 1.0 - chance))


def _beside(span: FloatArray, column: FloatArray) -> FloatArray:
    return np.asarray(column - span @ (span.T @ column))


def chance_of(name: str, observations: Observations) -> float:
    """Chance of a false alarm that the tracer allows each form of an effect in this table."""
    base = dividing_head_table(fit_jointly(observations), CATALOGUE)
    offered = candidates(base)
    names = [candidate.effect.name for candidate in offered]
    return FALSE_ALARM / len(set(names)) / names.count(name)


def graded(wanted: Wanted) -> Record:
    """Make one table and look for its effect in both ways."""
    spec, seed = wanted
    stage, case = make_stage(spec, seed), make_table(spec, seed)
    if stage is None or case is None:
        raise ValueError(f"{spec.design} cannot show {spec.effects} within the physical maximum.")
    ((name, units),) = spec.effects
    chance = chance_of(name, case.observations)
    spare = len(case.observations) - len(PARAMETERS) - 1
    visible = float(np.linalg.norm(oracle_column(stage))) / spec.noise_v
    loop = close_loop(case.observations)
    named = any(name == effect.name or name in effect.also_possible for effect in loop.effects)
    told = name in _TOLD and any(_TOLD[name] in warning for warning in loop.augmented.warnings)
    return {
        "key": _key(wanted),
        "effect": name,
        "shape": case.truth.shapes[name],
        "units": units,
        "said": [effect.name for effect in loop.effects],
        "ours": named,
        "told": named or told,
        "f_power": f_test_power(visible, chance, spare),
        "f_power_told": f_test_power(visible, CHANCE if name in _TOLD else chance, spare),
        "f_test": oracle_sees(stage, case.observations.output_v, chance),
    }


def _key(wanted: Wanted) -> str:
    spec, seed = wanted
    return json.dumps([seed, asdict(spec)])


def run(wanted: Sequence[Wanted], workers: int, results: Path | None) -> list[Record]:
    """Grade every table; those whose result is on file are taken from there."""
    done = read_results(results) if results else {}
    records = _graded_by([one for one in wanted if _key(one) not in done], workers)
    for record in streamed(records, results) if results else records:
        done[record["key"]] = record
        print(f"\r{len(done)} of {len(wanted)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return [done[_key(one)] for one in wanted]


def _graded_by(missing: Sequence[Wanted], workers: int) -> Iterator[Record]:
    if workers <= 1:
        yield from map(graded, missing)
        return
    with closing(get_context("spawn").Pool(workers)) as pool:
        yield from pool.imap(graded, missing)


Cell = tuple[str, float]
"""An effect and its signal in units of the noise."""


def cells(records: Sequence[Record]) -> dict[Cell, list[Record]]:
    """Records by effect and signal."""
    sorted_out: dict[Cell, list[Record]] = {}
    for record in records:
        sorted_out.setdefault((record["effect"], record["units"]), []).append(record)
    return dict(sorted(sorted_out.items()))


def report(by_cell: dict[Cell, list[Record]]) -> str:
    """The powers of every cell in percent, and the largest shortfall."""
    lines = [
        "| effect | signal | tables | close_loop | F test, exact | difference | F test, these tables "
        "| close_loop, named or told of | F test at the chance of that |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for (effect, units), records in by_cell.items():
        ours, exact, same = (100.0 * mean(records, key) for key in ("ours", "f_power", "f_test"))
        told, at_its_chance = (100.0 * mean(records, key) for key in ("told", "f_power_told"))
        lines.append(
            f"| {effect} | {units:g} | {len(records)} | {ours:.1f} | {exact:.1f} | {ours - exact:+.1f} | {same:.1f} "
            f"| {told:.1f} | {at_its_chance:.1f} |"
        )
    return "\n".join([*lines, "", _largest_shortfall(by_cell)])


def mean(records: Sequence[Record], key: str) -> float:
    """Mean of one entry of all records."""
    return float(np.mean([record[key] for record in records]))


def _largest_shortfall(by_cell: dict[Cell, list[Record]]) -> str:
    short = {
        cell: mean(records, "f_power") - mean(records, "ours")
        for cell, records in by_cell.items()
        if mean(records, "f_power") >= HALF
    }
    if not short:
        return "No signal at which the F test has a power of 50 %."
    effect, units = worst = max(short, key=lambda cell: short[cell])
    return f"Largest shortfall from 50 % on: {100.0 * short[worst]:.1f} points, {effect} at {units:g} noise units."


def draw(by_cell: dict[Cell, list[Record]], path: Path) -> None:
    """One panel for each effect: power against signal, `close_loop` as marks with intervals, the F test as a line."""
    effects = list(dict.fromkeys(effect for effect, _ in by_cell))
    rows, across = -(-len(effects) // 3), min(len(effects), 3)
    figure = Figure(figsize=(9.2, 0.6 + 2.5 * rows), layout="constrained")
    panels = list(figure.subplots(rows, across, sharex=True, sharey=True, squeeze=False).flat)
    for panel, effect in zip(panels, effects, strict=False):
        _draw_effect(panel, {units: records for (name, units), records in by_cell.items() if name == effect})
        panel.set_title(effect)
        panel.set_xlabel("visible signal (noise units)")
        panel.xaxis.set_tick_params(labelbottom=True)
    for unused in panels[len(effects) :]:
        unused.axis("off")
    panels[-1 if len(panels) > len(effects) else 0].legend(*panels[0].get_legend_handles_labels(), loc="center")
    for panel in panels[:: min(len(effects), 3)]:
        panel.set_ylabel("detected (%)")
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def _draw_effect(panel: Axes, by_units: dict[float, list[Record]]) -> None:
    units = list(by_units)
    ours = 100.0 * np.array([mean(records, "ours") for records in by_units.values()])
    ends = 100.0 * np.array([wilson(sum(r["ours"] for r in records), len(records)) for records in by_units.values()])
    exact = [100.0 * mean(records, "f_power") for records in by_units.values()]
    panel.plot(units, exact, color=INK, linewidth=1.2, label="F test that knows the effect (exact)")
    bars = np.clip(np.stack([ours - ends[:, 0], ends[:, 1] - ours]), 0.0, None)
    panel.errorbar(units, ours, yerr=bars, color=COLOURS[0], linestyle="", marker="o", markersize=4.0, elinewidth=1.0,
                   label="close_loop, 95 % interval")  # fmt: skip
    panel.set_ylim(-4.0, 104.0)


def main() -> None:
    """Run all tables, print the powers and draw them."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.power", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", choices=sorted(_SEEDS), default="development")
    parser.add_argument("--count", type=int, default=100, help="tables of each effect at each signal")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--results", type=Path, help="file of results, one line a table; continued where it exists")
    parser.add_argument("--out", type=Path, default=Path("docs/power.png"), help="the plot, PNG or SVG")
    given = parser.parse_args()
    by_cell = cells(run(power(_SEEDS[given.seeds], given.count), given.workers, given.results))
    print(report(by_cell))
    draw(by_cell, given.out)


if __name__ == "__main__":
    main()
