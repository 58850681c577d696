"""Makes tables, closes the loop on each and grades it, in as many processes as wanted."""

import time
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import asdict
from multiprocessing import get_context
from pathlib import Path

from benchmarks.bank import make_table
from benchmarks.bank.sparse import SparseSpec, make_sparse
from benchmarks.loop.jobs import Job, Record
from benchmarks.loop.measures import MEASURES
from benchmarks.loop.results import read_results, streamed
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop


def run(wanted: Sequence[Job], workers: int, out: Path | None) -> list[Record]:
    """Grade every table, in the order in which they are wanted; those whose result is on file are taken from there."""
    done = read_results(out) if out else {}
    missing = [job for job in wanted if job.key not in done]
    records = _graded_by(missing, workers)
    for record in streamed(records, out) if out else records:
        done[record["key"]] = record
    return [done[job.key] for job in wanted]


def _graded_by(missing: Sequence[Job], workers: int) -> Iterator[Record]:
    if workers <= 1 or len(missing) <= 1:
        yield from map(graded, missing)
        return
    with closing(get_context("spawn").Pool(workers)) as pool:
        yield from pool.imap(graded, missing)


def graded(job: Job) -> Record:
    """Make one table, close the loop on it and grade the result.

    A table that the design cannot show is kept with `shown` false; one on which the analysis fails with its `failure`.
    """
    record: Record = {
        "key": job.key,
        "list": job.list_name,
        "seed": job.seed,
        "spec": asdict(job.spec),
        "shown": False,
        "failure": None,
    }
    case = make_sparse(job.spec, job.seed) if isinstance(job.spec, SparseSpec) else make_table(job.spec, job.seed)
    if case is None:
        return record
    start = time.perf_counter()
    try:
        loop = close_loop(case.observations)
    except Exception as error:  # whatever it is, the table counts as failed and the others are still graded
        return record | {"shown": True, "failure": repr(error)}
    seconds = time.perf_counter() - start
    return record | {"shown": True, "seconds": seconds} | MEASURES[job.measure].grade(case, loop)
