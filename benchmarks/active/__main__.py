"""Command line: `python -m benchmarks.active --verbose`."""

import argparse
from collections.abc import Iterator, Sequence
from contextlib import closing
from multiprocessing import get_context
from pathlib import Path

import benchmarks.active
from benchmarks.active import unnamed
from benchmarks.active.cases import FIRST
from benchmarks.active.grading import failures, report
from benchmarks.active.running import Job, Record, graded
from benchmarks.bank import DEVELOPMENT, REPORTED
from benchmarks.loop.results import read_results, streamed

_SEEDS = {"development": DEVELOPMENT, "reported": REPORTED}


def main() -> None:
    """Grade as many cases as the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.active",
        description=benchmarks.active.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--seeds", choices=sorted(_SEEDS), default="development")
    parser.add_argument("--unnamed", action="store_true", help="effects outside the catalogue, to be located")
    parser.add_argument("--count", type=int, default=160, help="cases, ambiguous or not")
    parser.add_argument("--skip", type=int, default=0, help="cases that were used before")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--out", type=Path, help="file of results, one line for each case; continued where it exists")
    parser.add_argument("--verbose", action="store_true", help="list every case that went wrong")
    given = parser.parse_args()
    first = (unnamed.FIRST if given.unnamed else FIRST) + given.skip
    seeds = _SEEDS[given.seeds][first : first + given.count]
    wanted = [Job(seed=seed, unnamed=given.unnamed) for seed in seeds]
    records = _run(wanted, given.workers, given.out)
    print(report(records))
    if given.verbose:
        print("\n".join(failures(records)))


def _run(wanted: Sequence[Job], workers: int, out: Path | None) -> list[Record]:
    done = read_results(out) if out else {}
    missing = [job for job in wanted if job.key not in done]
    records = _graded_by(missing, workers)
    for record in streamed(records, out) if out else records:
        done[str(record["key"])] = record
    return [done[job.key] for job in wanted]


def _graded_by(missing: Sequence[Job], workers: int) -> Iterator[Record]:
    if workers <= 1:
        yield from map(graded, missing)
        return
    with closing(get_context("spawn").Pool(workers)) as pool:
        yield from pool.imap(graded, missing)


if __name__ == "__main__":
    main()
