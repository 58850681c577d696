"""Whether stated intervals hold the true parameters, and how much of the error of the declared model is gone.

Tables are those of the bank's `mixture`. Of every parameter that is stated without a condition: does its 95% interval
hold the true value, and is it more than five standard uncertainties off? Parameters that are not stated are counted
beside those that the oracle cannot tell either. The part of the error that is left is

    (after - oracle) / (before - oracle),

each the mean square, over the rows in use before and after, of what a fit says minus the reading without noise: the
declared model, the augmented one, and the oracle of `oracle`. It is taken for tables with an effect other than
misreadings, whose rows are set aside before as after.
"""

from collections.abc import Sequence

import numpy as np

from benchmarks.bank import Case, Stage, make_stage, mixture
from benchmarks.bank.dwells import IntArray
from benchmarks.bank.geometry import FloatArray
from benchmarks.loop.intervals import percent, wilson
from benchmarks.loop.jobs import Job, Record, described, jobs
from benchmarks.loop.oracle import PARAMETERS, ask_oracle
from benchmarks.loop.reported import said
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.result import Calibration

_FAR, _MUCH = 5.0, 0.2


def wanted(seeds: range, count: int | None) -> list[Job]:
    """A mixture of tables; 10,000 unless told."""
    return jobs("coverage", "mixture", mixture(seeds, count or 10_000))


def grade(case: Case, loop: Loop) -> Record:
    """Compare parameters and fitted output with the truth."""
    truth = case.truth
    stage = make_stage(truth.spec, truth.seed)
    assert stage is not None, "the table was made"
    true = dict(zip(PARAMETERS, vars(truth.unit).values(), strict=True))
    stated = {name: _stated(parameter, true[name]) for name, parameter in loop.augmented.parameters.items()}
    return {"said": said(loop), "parameters": stated, **_errors(case, stage, loop)}


def _stated(parameter: Parameter, true: float) -> Record:
    """How one parameter is stated, and how far off it is in standard uncertainties."""
    if parameter.value is None or parameter.interval_95 is None or not parameter.standard_uncertainty:
        return {"stated": "not at all"}
    if parameter.given:
        return {"stated": "given alpha0"}
    low, high = parameter.interval_95
    off = (parameter.value - true) / parameter.standard_uncertainty
    return {"stated": "as it is", "inside": low <= true <= high, "off": off}


def _errors(case: Case, stage: Stage, loop: Loop) -> Record:
    """Mean squares in square volts before, after and by the oracle, and what the oracle cannot tell."""
    before, after = _fitted(loop.declared), _fitted(loop.augmented)
    rows = np.array(sorted(before.keys() & after.keys()), dtype=np.int64)
    used = rows - 1
    oracle = ask_oracle(stage, _readings(case)[used], used, case.truth.spec.noise_v)
    fits = {
        "before": np.array([before[row] for row in rows.tolist()]),
        "after": np.array([after[row] for row in rows.tolist()]),
        "oracle": oracle.fitted_v[used],
    }
    return {"oracle_unknown": list(oracle.unknown)} | {
        name: _mean_square(fit, case.truth.noise_free_v, used) for name, fit in fits.items()
    }


def _fitted(calibration: Calibration) -> dict[int, float]:
    """Fitted output by number of the row, in volts."""
    observations = calibration.observations
    fitted = observations.output_v - calibration.residual_v
    return dict(zip(observations.row.tolist(), fitted.tolist(), strict=True))


def _readings(case: Case) -> FloatArray:
    return case.observations.output_v


def _mean_square(fitted_v: FloatArray, true_v: FloatArray, used: IntArray) -> float:
    return float(np.mean((fitted_v - true_v[used]) ** 2))


def part_left(record: Record) -> float | None:
    """Part of the error that is left; None where no effect but misreadings is there."""
    names = {name for name, _ in record["spec"]["effects"]} - {"misreading"}
    if not names or "before" not in record:
        return None
    return (record["after"] - record["oracle"]) / (record["before"] - record["oracle"])


def report(records: Sequence[Record]) -> str:
    """Coverage of every parameter, then the part of the error that is left."""
    graded = [record for record in records if "parameters" in record]
    shown = sum(record["shown"] for record in records)
    heads = ("parameter", "stated", "in the 95 % interval", "95 % (Wilson)", "beyond 5 u", "given alpha0")
    heads = (*heads, "not stated", "oracle cannot tell", "not stated though the oracle can")
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += [_line(name, graded, (name,)) for name in PARAMETERS]
    lines.append(_line("all", graded, PARAMETERS))
    title = f"{len(records)} tables, {shown} showable, {len(graded)} graded"
    return "\n".join([title, *lines, _left(graded)])


def failures(records: Sequence[Record]) -> list[str]:
    """Tables on which the analysis failed, a parameter is far off, or much of the error is left."""
    lines = [f"FAILED {described(record)}: {record['failure']}" for record in records if record["failure"]]
    for record in records:
        for name, stated in record.get("parameters", {}).items():
            if abs(stated.get("off", 0.0)) > _FAR:
                lines.append(f"{name} {stated['off']:+.1f} u: {described(record)}: {record['said']}")
        left = part_left(record)
        if left is not None and left > _MUCH:
            lines.append(f"{left:.0%} of the error left: {described(record)}: {record['said']}")
    return lines


def _line(title: str, graded: Sequence[Record], names: Sequence[str]) -> str:
    pairs = [(record, name) for record in graded for name in names]
    how = [record["parameters"][name]["stated"] for record, name in pairs]
    told = [record["parameters"][name] for record, name in pairs if record["parameters"][name]["stated"] == "as it is"]
    inside = sum(stated["inside"] for stated in told)
    far = sum(abs(stated["off"]) > _FAR for stated in told)
    low, high = wilson(inside, len(told))
    unknown = [name in record["oracle_unknown"] for record, name in pairs]
    lost = sum(stated == "not at all" and not hidden for stated, hidden in zip(how, unknown, strict=True))
    cells = (
        title,
        len(told),
        percent(inside, len(told)),
        f"{100.0 * low:.2f} to {100.0 * high:.2f}",
        f"{far} ({percent(far, len(told))})",
        percent(how.count("given alpha0"), len(pairs)),
        percent(how.count("not at all"), len(pairs)),
        percent(sum(unknown), len(pairs)),
        percent(lost, len(pairs)),
    )
    return "| " + " | ".join(map(str, cells)) + " |"


def _left(graded: Sequence[Record]) -> str:
    left = [part for record in graded if (part := part_left(record)) is not None]
    if not left:
        return "No table with an effect."
    return (
        f"Part of the error left, {len(left)} tables with effects: median {np.median(left):.4f}, "
        f"95th percentile {np.quantile(left, 0.95):.4f}"
    )
