"""Command line: `python -m benchmarks.loop exactness --verbose`."""

import argparse
from pathlib import Path

import benchmarks.loop
from benchmarks.bank import DEVELOPMENT, REPORTED
from benchmarks.loop.measures import MEASURES
from benchmarks.loop.running import run

_SEEDS = {"development": DEVELOPMENT, "reported": REPORTED}


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.loop",
        description=benchmarks.loop.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("measure", choices=sorted(MEASURES))
    parser.add_argument("--seeds", choices=sorted(_SEEDS), default="development")
    parser.add_argument("--count", type=int, help="tables in all; of exactness: of each list")
    parser.add_argument("--workers", type=int, default=2, help="processes; timing should have one")
    parser.add_argument("--out", type=Path, help="file of results, one line for each table; continued where it exists")
    parser.add_argument("--verbose", action="store_true", help="list every table that went wrong")
    return parser


def main() -> None:
    """Run the measure that the command line asks for."""
    given = _arguments().parse_args()
    measure = MEASURES[given.measure]
    records = run(measure.wanted(_SEEDS[given.seeds], given.count), given.workers, given.out)
    print(measure.report(records))
    if given.verbose:
        print("\n".join(measure.failures(records)))


if __name__ == "__main__":
    main()
