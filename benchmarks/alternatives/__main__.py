"""Command line: `python -m benchmarks.alternatives`."""

import argparse
import sys

import benchmarks.alternatives
from benchmarks.alternatives.columns import Problem
from benchmarks.alternatives.comparison import Answer, by_columns, compare, held_out, report, sheets
from benchmarks.alternatives.stepwise import stepwise
from benchmarks.bank import DEVELOPMENT, REPORTED

try:
    from benchmarks.alternatives.lasso import lasso
    from benchmarks.alternatives.process import Process
    from benchmarks.alternatives.sindy import sindy
except ModuleNotFoundError as error:
    raise SystemExit(f"There is no {error.name} here; install it with: pip install -e '.[bench]'") from None

_SEEDS = {"development": DEVELOPMENT, "reported": REPORTED}


def gaussian_process(given: Problem) -> Answer:
    """What a process without physics makes of a table: a variable and a prediction, and no names."""
    process = Process(given)
    variables = frozenset([process.variable] if process.variable else [])
    return Answer(names=None, variables=variables, held_out=held_out(given, process.errors))


_METHODS = {
    "stepwise BIC": by_columns(stepwise),
    "LassoCV + OLS": by_columns(lasso),
    "PySINDy STLSQ": by_columns(sindy),
    "Gaussian process": gaussian_process,
}


def main() -> None:
    """Run all methods and print how they compare."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.alternatives",
        description=benchmarks.alternatives.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--seeds", choices=sorted(_SEEDS), default="development")
    parser.add_argument("--count", type=int, default=40, help="tables of each list")
    given = parser.parse_args()
    outcomes = []
    for outcome in compare(sheets(_SEEDS[given.seeds], given.count), _METHODS):
        outcomes.append(outcome)
        print(f"\r{len(outcomes)} results", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    print(report(outcomes))


if __name__ == "__main__":
    main()
