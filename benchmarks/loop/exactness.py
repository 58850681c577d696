"""Whether every table is traced to exactly what was put in, and whether its rivals are those of an independent refit.

A table is exact where effects there and effects reported pair up one to one, each there under its name or among
`also_possible`, and where structure without a name is reported exactly if there is some, with the right variable.
Rivals of tables with white noise are confirmed by `rivals`; noise-like effects (realisation_bias, seating,
bias_random_walk) are left out of that, as found ones and as rivals.
"""

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from benchmarks.bank import Case, beyond, heavy, missing_columns, novel, pairs, singles, triples
from benchmarks.loop.intervals import wilson
from benchmarks.loop.jobs import Job, Record, described, jobs, spread_out
from benchmarks.loop.matching import as_well, is_exact
from benchmarks.loop.reported import said
from benchmarks.loop.rivals import CLOSE, MARGIN, judged_rivals
from tumble.calibrations.methods.dividing_head.loop.loop import Loop

_LISTS = (singles, pairs, triples, novel, missing_columns, heavy, beyond)


def wanted(seeds: range, count: int | None) -> list[Job]:
    """All tables of the lists, or `count` of each."""
    return [job for make in _LISTS for job in spread_out(jobs("exactness", make.__name__, make(seeds)), count)]


def grade(case: Case, loop: Loop) -> Record:
    """Judge names, and rivals where noise is white."""
    truth = case.truth
    white = truth.spec.noise == "white" and not truth.spec.quantum_v
    return {
        "exact": is_exact(truth.effects, as_well(case, loop.unexplained), loop.effects, loop.unexplained),
        "said": said(loop),
        "shapes": dict(truth.shapes),
        "rivals": [asdict(judged) for judged in judged_rivals(loop)] if white else [],
    }


def report(records: Sequence[Record]) -> str:
    """A table with a line for each list, and how it is read."""
    names = list(dict.fromkeys(record["list"] for record in records))
    heads = ("list", "not showable", "graded", "exact", "%", "95 % (Wilson)")
    heads = (*heads, "rivals listed: confirmed", "contradicted", "rivals not listed", "median s")
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += [_line(name, [record for record in records if record["list"] == name]) for name in names]
    return "\n".join([*lines, _line("all", records)])


def failures(records: Sequence[Record]) -> list[str]:
    """Tables that were not traced to what is there, and rivals that an independent refit does not confirm."""
    wrong = [
        f"NOT EXACT {described(record)} {record.get('shapes', '')}: {record['failure'] or record['said']}"
        for record in records
        if record["shown"] and not record.get("exact")
    ]
    doubted = [
        f"RIVAL {described(record)}: {judged['rival']} for {judged['name']} is {judged['behind']:.2f} behind, "
        + ("listed" if judged["listed"] else "not listed")
        for record in records
        for judged in record.get("rivals", ())
        if _outcome(judged) in {"contradicted", "missed"}
    ]
    return wrong + doubted


def _outcome(judged: Record) -> str:
    """What the refit says of one effect in the place of another."""
    if abs(judged["behind"] - CLOSE) <= MARGIN:
        return "too close"
    if judged["behind"] < CLOSE:
        return "confirmed" if judged["listed"] else "missed"
    return "contradicted" if judged["listed"] else "rightly not listed"


def _line(name: str, records: Sequence[Record]) -> str:
    graded = [record for record in records if record["shown"]]
    exact = sum(record.get("exact", False) for record in graded)
    low, high = wilson(exact, len(graded))
    outcomes = [_outcome(judged) for record in graded for judged in record.get("rivals", ())]
    seconds = [record["seconds"] for record in graded if "seconds" in record]
    part = f"{100.0 * exact / len(graded):.1f}" if graded else "–"
    counts = " | ".join(str(outcomes.count(outcome)) for outcome in ("confirmed", "contradicted", "missed"))
    return (
        f"| {name} | {len(records) - len(graded)} | {len(graded)} | {exact} | {part} "
        f"| {100.0 * low:.1f} to {100.0 * high:.1f} | {counts} | {np.median(seconds) if seconds else np.nan:.2f} |"
    )
