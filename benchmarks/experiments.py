"""Does a proposed experiment tell as much as it promises? On tables of the bank with one effect that has rivals.

    python -m benchmarks.experiments [--tables 10] [--draws 5]

For each table: the first experiment that `next_experiments` proposes, with what it predicts for the difference in
-2 ln L between the effect that is really there and each rival that is told apart. Then the experiment is carried out on
the bank's unit, with new noise in every draw, and both explanations are fitted to table and probe rows together.

What is fitted to noise counts too: a fit with more coefficients gains one for each. Predicted are the differences
without that; so are those that are printed as realised, on average over the draws.
"""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.bank import DEVELOPMENT, Spec, Stage, make_stage, make_table, read_on
from benchmarks.bank.dwells import Dwells
from benchmarks.bank.geometry import AXES
from benchmarks.bank.lists import designs_for
from benchmarks.bank.scene import Run
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.tracing.experiments import next_experiments
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.penalties import CLOSE
from tumble.calibrations.tracing.rivals import with_best_names
from tumble.calibrations.tracing.separation import PlannedRows, Question
from tumble.calibrations.tracing.trace import Tracer, found, refined_one

_EFFECTS = (
    "k_xx", "k_yy", "k_xxx", "scale_asymmetry", "hysteresis", "head_eccentricity", "head_second_harmonic", "backlash",
    "daq_nonlinearity", "bias_drift", "base_tilt_drift", "settling",
)  # fmt: skip
"""Those that a longer run leaves as they are."""
_VISIBLE = 12.0
_FIRST_SEED = DEVELOPMENT[950_000]
"""Beyond the seeds of the lists."""


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """One rival told apart by one experiment."""

    seed: int
    design: str
    true: str
    rival: str
    programme: str
    predicted: float
    realised: float
    """Mean over the draws."""
    promised: float = 0.0
    """What the difference was to reach at least, with what is there already."""


def outcomes(tables: int, draws: int) -> Iterator[Outcome]:
    """The first experiment of so many tables."""
    counted = 0
    for spec, seed in _wanted():
        listed = list(_outcomes(spec, seed, draws))
        yield from listed
        counted += bool(listed)
        if counted == tables:
            return


def _wanted() -> Iterator[tuple[Spec, int]]:
    cells = [(name, design) for turn in range(8) for name in _EFFECTS for design in designs_for(name)[turn : turn + 1]]
    for number, (name, design) in enumerate(cells):
        yield Spec(design=design, realisations=3, effects=((name, _VISIBLE),)), _FIRST_SEED + number


def _outcomes(spec: Spec, seed: int, draws: int) -> Iterator[Outcome]:
    """Of one table; nothing where it is traced to something else, or asks for no experiment."""
    case, stage = make_table(spec, seed), make_stage(spec, seed)
    if case is None or stage is None:
        return
    ((true, _),) = spec.effects
    base = dividing_head_table(fit_jointly(case.observations), CATALOGUE)
    tracer = Tracer(base)
    trace, near = with_best_names(tracer, tracer.trace())
    close = {name: [rival for rival in rivals if rival.behind < CLOSE] for name, rivals in near.items()}
    if len(trace.found) != 1 or not trace.noise.white:
        return
    for experiment in next_experiments(base, trace, close, PROBES)[:1]:
        if experiment.outlook is None:
            return
        name, *apart = experiment.separates
        question = Question(base, trace, name, [rival for rival in close[name] if rival.name in apart])
        rows = experiment.outlook.rows
        told = question.expected(_rows(question.table, rows))
        for (way, number), expected in np.ndenumerate(told.separations):
            pair = (name, question.rivals[number])
            if pair[way] == true:
                yield Outcome(
                    seed=seed,
                    design=spec.design,
                    true=true,
                    rival=pair[1 - way],
                    programme=experiment.programme,
                    predicted=float(expected),
                    promised=float(told.promises[way, number]),
                    realised=_realised(case.observations, rows, (spec, seed, stage), (true, pair[1 - way]), draws),
                )


def _realised(
    table: Observations, rows: Observations, made: tuple[Spec, int, Stage], pair: tuple[str, str], draws: int
) -> float:
    """Mean difference in -2 ln L, the coefficients that one has more counted."""
    spec, seed, stage = made
    quiet_v = read_on(spec, seed, stage, _longer(stage.run, rows))
    assert np.allclose(quiet_v[: len(stage.run.dwells)], make_table(spec, seed).truth.noise_free_v)
    new = len(rows) - len(table)
    differences = []
    for draw in range(draws):
        noise_v = np.random.default_rng((seed, 10_000 + draw)).normal(0.0, spec.noise_v, new)
        volts = np.concatenate([table.output_v, quiet_v[-new:] + noise_v])
        tracer = Tracer(dividing_head_table(fit_jointly(replace(rows, voltage_v=volts)), CATALOGUE))
        true, other = (_deviance(tracer, name) for name in pair)
        differences.append(other - true)
    return float(np.mean(differences))


def _rows(table: PlannedRows, whole: Observations) -> PlannedRows:
    """The rows of a table with those that come after it, of weight 1."""
    added = len(whole) - len(table.weights)
    return PlannedRows(
        rows=whole,
        weights=np.pad(table.weights, (0, added), constant_values=1.0),
        programmes=np.pad(table.programmes, (0, added)),
    )


def _deviance(tracer: Tracer, name: str) -> float:
    """-2 ln L of the best fit with one effect, each of its coefficients counted for one."""
    problem = tracer.problem(NoiseModel())
    forms = problem.forms[name]
    best = forms.start + int(np.argmax(problem.gains(problem.explain(()))[forms]))
    fine = refined_one(tracer.table, found(problem, best), (), NoiseModel())
    return tracer.table.deviance([fine.form], NoiseModel()) + fine.coefficients


def _longer(run: Run, rows: Observations) -> Run:
    """The run with the dwells of the probes after it."""
    first, count = run.dwells, len(run.dwells)
    seated = np.diff(np.unique(rows.mounts, return_inverse=True)[1], prepend=0)[count:] != 0
    begins = np.diff(rows.realisations, prepend=0)[count:] != 0
    dwells = Dwells(
        realisation=rows.realisations,
        procedure=np.concatenate([first.procedure, np.full(len(seated), "sweep")]),
        mount=rows.mounts,
        angle_deg=rows.angle_deg,
        time_s=rows.time_s,
        direction=rows.direction,
        follows=np.concatenate([first.follows, ~(seated | begins)]),
        mounting=np.concatenate([first.mounting, first.mounting[-1] + np.cumsum(seated)]),
        axes=np.stack([AXES[name] for name in rows.mounts]),
    )
    return Run(
        dwells=dwells,
        temperature_degc=np.concatenate([run.temperature_degc, rows.temperature_degc[count:]]),
        expected_sd_v=np.pad(run.expected_sd_v, (0, len(seated)), mode="edge"),
        measured_sd_v=np.pad(run.measured_sd_v, (0, len(seated)), mode="edge"),
    )


def report(found: Sequence[Outcome]) -> str:
    """Every rival, and the ratio of the sums."""
    lines = [
        "| true | rival | design | experiment | predicted | realised | ratio | promised |",
        "|---|---|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {each.true} | {each.rival} | {each.design} | {each.programme} | {each.predicted:.1f} | {each.realised:.1f} "
        f"| {each.realised / each.predicted:.2f} | {each.promised:.1f} |"
        for each in found
    ]
    ratios = [each.realised / each.predicted for each in found]
    tables = len({each.seed for each in found})
    return "\n".join(
        [
            *lines,
            "",
            f"as much as promised, or more: {sum(each.realised >= each.promised for each in found)} of {len(found)}",
            f"{tables} tables, {len(found)} rivals: median ratio {np.median(ratios):.2f}, mean {np.mean(ratios):.2f}",
        ]
    )


def main() -> None:
    """Carry out experiments and print what they told."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.experiments",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--tables", type=int, default=10)
    parser.add_argument("--draws", type=int, default=5)
    given = parser.parse_args()
    print(report(list(outcomes(given.tables, given.draws))))


if __name__ == "__main__":
    main()
