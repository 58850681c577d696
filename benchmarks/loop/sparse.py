"""How often something is stated of tables that hold too few settings to tell it.

Nothing that has a name is in them: any effect that is named is a false statement, and so is structure in a clean table.
Parameters are counted that are stated without a condition and are off by more than five standard uncertainties.
"""

from collections.abc import Sequence

from benchmarks.bank import Case
from benchmarks.bank.sparse import KINDS, sparse
from benchmarks.loop.intervals import percent
from benchmarks.loop.jobs import Job, Record
from benchmarks.loop.reported import said
from tumble.calibrations.methods.dividing_head.loop.loop import Loop


def wanted(seeds: range, count: int | None) -> list[Job]:
    """Tables of every kind by turns; 600 in all unless told."""
    return [
        Job(measure="sparse", list_name=spec.kind, spec=spec, seed=seed) for spec, seed in sparse(seeds, count or 600)
    ]


def grade(case: Case, loop: Loop) -> Record:  # noqa: ARG001
    """Keep what was named, and what was said to be there without a name."""
    return {
        "named": [effect.name for effect in loop.effects],
        "unexplained": loop.unexplained is not None,
        "said": said(loop),
        "withheld": [each.name for each in loop.withheld],
    }


def report(records: Sequence[Record]) -> str:
    """A table with a line for each kind."""
    lines = [
        "| kind | tables | something named | structure without a name | withheld | failed |",
        "|---|---|---|---|---|---|",
    ]
    return "\n".join(lines + [_line(kind, [record for record in records if record["list"] == kind]) for kind in KINDS])


def failures(records: Sequence[Record]) -> list[str]:
    """False statements."""
    return [
        f"{record['spec']}, seed {record['seed']}: {record['failure'] or record['said']}"
        for record in records
        if _false(record)
    ]


def _false(record: Record) -> bool:
    return bool(record["failure"] or record["named"] or (record["list"] == "clean" and record["unexplained"]))


def _line(kind: str, records: Sequence[Record]) -> str:
    graded = [record for record in records if not record["failure"]]
    counts = [sum(bool(record[key]) for record in graded) for key in ("named", "unexplained", "withheld")]
    cells = [f"{count} ({percent(count, len(graded))})" for count in counts]
    return f"| {kind} | {len(graded)} | {' | '.join(cells)} | {len(records) - len(graded)} |"
