"""How long it takes to close the loop on 1,230 rows with effects in them, on one core."""

from collections.abc import Sequence

import numpy as np

from benchmarks.bank import Case, Spec, pairs, singles, triples
from benchmarks.loop.jobs import Job, Record, jobs, spread_out
from tumble.calibrations.methods.dividing_head.loop.loop import Loop

_DESIGN = "bfd"
"""With five realisations, 1,230 rows."""


def wanted(seeds: range, count: int | None) -> list[Job]:
    """Tables with one, two and three effects; 30 unless told."""
    lists = {"singles": singles(seeds), "pairs": pairs(seeds), "triples": triples(seeds)}
    everything = [job for name, listed in lists.items() for job in jobs("timing", name, listed)]
    return spread_out(
        [job for job in everything if isinstance(job.spec, Spec) and job.spec.design == _DESIGN], count or 30
    )


def grade(case: Case, loop: Loop) -> Record:
    """Keep the number of rows and of effects found; the time is kept of every table anyway."""
    return {"rows": len(case.observations), "found": len(loop.effects)}


def report(records: Sequence[Record]) -> str:
    """Median and 95th percentile of the time."""
    seconds = [record["seconds"] for record in records if "seconds" in record]
    rows = sorted({record["rows"] for record in records if "rows" in record})
    return (
        f"{len(seconds)} tables of {rows} rows: median {np.median(seconds):.3f} s, "
        f"95th percentile {np.quantile(seconds, 0.95):.3f} s"
    )


def failures(records: Sequence[Record]) -> list[str]:
    """Tables on which the analysis failed."""
    return [record["failure"] for record in records if record["failure"]]
