"""The outcome of many tables, by kind, with Wilson intervals."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Final

import numpy as np
from scipy.stats import binomtest

Record = Mapping[str, Any]
"""A table's identity, truth and judgement, as in the JSON."""

_FAR: Final = 2.5
_NO_WORSE: Final = 1.02


def share(good: int, count: int) -> str:
    """Return "good of count, per cent (95% Wilson interval)"."""
    if not count:
        return "–"
    interval = binomtest(good, count).proportion_ci(method="wilson")
    return f"{good}/{count} {100 * good / count:.1f}% ({100 * interval.low:.1f} to {100 * interval.high:.1f})"


def by_kind(records: Sequence[Record]) -> str:
    """Return a Markdown table with a line for each kind."""
    kinds = list(dict.fromkeys(record["kind"] for record in records))
    heads = ("kind", "exact", "inside interval_95", "> 2.5 half widths", "conditional inside", "withheld",
             "stated held-out ≤ 1.02", "fresh ≤ 1.02", "median s")  # fmt: skip
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    lines += [_line(kind, [record for record in records if record["kind"] == kind]) for kind in kinds]
    return "\n".join([*lines, _line("all", records)])


def _line(name: str, records: Sequence[Record]) -> str:
    parameters = [judged for record in records for judged in record["parameters"].values()]
    free, tied = ([judged for judged in parameters if judged["state"] == state] for state in _STATES)
    stated = [record["held_out_stated"] for record in records]
    fresh = [record["fresh_rms_v"] for record in records if None not in record["fresh_rms_v"]]
    cells = (
        name,
        _share_of(records, lambda record: record["exact"]),
        _share_of(free, lambda judged: judged["inside"]),
        _share_of(free, lambda judged: judged["half_widths"] > _FAR),
        _share_of(tied, lambda judged: judged["inside"]),
        _share_of(parameters, lambda judged: judged["state"] == "withheld"),
        _share_of(stated, _no_worse),
        _share_of(fresh, _no_worse),
        f"{np.median([record['seconds'] for record in records]):.2f}",
    )
    return "| " + " | ".join(cells) + " |"


_STATES: Final = ("unconditional", "conditional")


def _no_worse(pair: Sequence[float | None]) -> bool:
    before, after = pair
    return before is not None and after is not None and after <= _NO_WORSE * before


def _share_of(of: Sequence[Any], good: Callable[[Any], bool]) -> str:
    return share(sum(map(good, of)), len(of))


def unnamed_lines(records: Iterable[Record]) -> str:
    """Return how often structure without a name was found on a right variable: by size and by kind.

    With nothing named beside it it is exact. Where one catalogue effect does as well, its name alone is no mistake.
    """
    strange = [record for record in records if record["unnamed"]]
    sizes = sorted({units for record in strange for units in record["noise_units"].values()})
    lines = [f"{units:g} units: " + _share_of(_with(strange, units), lambda record: record["exact"]) for units in sizes]
    kinds = dict.fromkeys(record["unnamed"][0] for record in strange)
    grouped = {kind: [record for record in strange if record["unnamed"][0] == kind] for kind in kinds}
    lines += [
        "on a right variable, whatever is named beside it: "
        + _share_of(strange, lambda record: record["right_variable"]),
        "exact, or a catalogue effect that does as well: " + _share_of(strange, _no_mistake),
    ]
    lines += [f"{kind}: {sum(record['exact'] for record in group)}/{len(group)}" for kind, group in grouped.items()]
    return "\n".join(lines)


def _no_mistake(record: Record) -> bool:
    return bool(record["exact"] or record["said"].split("|")[0] in record["stand_ins"])


def _with(records: Sequence[Record], units: float) -> list[Record]:
    return [record for record in records if units in record["noise_units"].values()]


def misses(records: Iterable[Record]) -> str:
    """Return a line for each table that was not traced to what is there."""
    return "\n".join(
        f"{record['id']} [{record['design']}, {record['nuisance']}] {record['noise_units'] or 'clean'}: "
        + record["said"]
        + (f"; right: {', '.join(record['right_variables'])}" if record["unnamed"] else "")
        for record in records
        if not record["exact"]
    )
