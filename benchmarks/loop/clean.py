"""How often an effect is found, or structure without a name, where there is none.

White noise, Student's t with 4 degrees of freedom, 2 % contamination, flicker with an Allan floor of 20 µV, and
readings rounded to 100 µV and 300 µV, in every design.
"""

from collections.abc import Sequence

from benchmarks import bank
from benchmarks.bank import Case
from benchmarks.loop.intervals import clopper_pearson_upper, percent
from benchmarks.loop.jobs import Job, Record, described, jobs
from benchmarks.loop.reported import said
from tumble.calibrations.methods.dividing_head.loop.loop import Loop

_KINDS = 6


def wanted(seeds: range, count: int | None) -> list[Job]:
    """As many tables of every kind of noise, the designs by turns; 1,200 in all unless told."""
    of_each = max((count or 1200) // _KINDS, 1)
    return jobs("clean", "clean", bank.clean(seeds, of_each)) + jobs("clean", "heavy", bank.heavy(seeds, of_each))


def grade(case: Case, loop: Loop) -> Record:  # noqa: ARG001
    """Keep what was found."""
    return {"named": bool(loop.effects), "unexplained": loop.unexplained is not None, "said": said(loop)}


def report(records: Sequence[Record]) -> str:
    """A table with the rates of every kind; an upper end of 95 % is that of Clopper and Pearson."""
    kinds = list(dict.fromkeys(_kind(record) for record in records))
    lines = [
        "| noise | tables | named | unexplained | either | at most (95 %) | failed |",
        "|---|---|---|---|---|---|---|",
    ]
    lines += [_line(kind, [record for record in records if _kind(record) == kind]) for kind in kinds]
    return "\n".join([*lines, _line("all", records)])


def failures(records: Sequence[Record]) -> list[str]:
    """What was found in clean tables."""
    return [f"{described(record)}: {record['failure'] or record['said']}" for record in records if _false(record)]


def _kind(record: Record) -> str:
    quantum_v = record["spec"]["quantum_v"]
    return f"rounded to {quantum_v * 1e6:.0f} µV" if quantum_v else str(record["spec"]["noise"])


def _false(record: Record) -> bool:
    return bool(record["failure"]) or record["named"] or record["unexplained"]


def _line(kind: str, records: Sequence[Record]) -> str:
    failed = [record for record in records if record["failure"]]
    graded = [record for record in records if not record["failure"]]
    named = sum(record["named"] for record in graded)
    unexplained = sum(record["unexplained"] for record in graded)
    either = sum(map(_false, graded))
    most = 100.0 * clopper_pearson_upper(either, len(graded))
    return (
        f"| {kind} | {len(graded)} | {percent(named, len(graded))} | {percent(unexplained, len(graded))} "
        f"| {percent(either, len(graded))} | {most:.2f} % | {len(failed)} |"
    )
