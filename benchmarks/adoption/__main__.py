"""Adopts effects of unit types, and prints what that does: `python -m benchmarks.adoption`."""

import argparse
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from benchmarks.adoption.judging import FIRST_UNITS, FURTHER, Outcome, medians, outcome, removed
from benchmarks.bank import DEVELOPMENT, REPORTED

_SEEDS = {"development": DEVELOPMENT, "reported": REPORTED}
_FIRST = 980_001
"""Beyond the seeds of the lists of the bank."""


def row(found: Outcome) -> str:
    """A type in a line of a table."""
    further = found.further
    declared, unnamed, adopted = medians(further)
    inside, stated = sum(each.inside for each in further), sum(each.stated for each in further)
    sizes = [each for each in further if each.size is not None and each.size_uncertainty is not None]
    near = sum(abs(each.size - each.true_size) <= 2.0 * each.size_uncertainty for each in sizes)  # type: ignore[operator]
    cells = (
        found.seed,
        f"{found.kind.kind}, {abs(found.kind.size_v) * 1e6:.0f} µV",
        f"{found.found} of {FIRST_UNITS}",
        f"{100 * found.spread:.0f}% ({100 * found.true_spread:.0f}%)",
        f"{sum(each.named for each in further)} of {FURTHER}, alone {sum(each.alone for each in further)}",
        f"{declared * 1e6:.1f} µV",
        f"{unnamed * 1e6:.1f} µV",
        f"{adopted * 1e6:.1f} µV",
        f"{inside} of {stated}",
        f"{near} of {len(sizes)}",
        sum(bool(each.said_against) for each in further),
        "yes" if any("is not there" in each for each in found.lacking) else "no",
    )
    return "| " + " | ".join(map(str, cells)) + " |"


_HEADINGS = (
    "seed",
    "effect",
    "found on the first",
    "spread (true)",
    "named on further units",
    "held out: declared",
    "unnamed",
    "adopted",
    "parameters inside",
    "sizes within 2 u",
    "contradicted by further units",
    "by the unit that lacks it",
)


def report(found: Sequence[Outcome]) -> str:
    """Every type, and all of them together."""
    lines = ["| " + " | ".join(_HEADINGS) + " |", "|" + "---|" * len(_HEADINGS), *map(row, found)]
    further = [each for one in found for each in one.further]
    parts = [removed(each.error.declared, each.error.adopted) for each in further]
    anew = [removed(each.error.declared, each.error.unnamed) for each in further]
    worse = sum(each.error.adopted > 1.02 * each.error.declared for each in further)
    inside, stated = sum(each.inside for each in further), sum(each.stated for each in further)
    return "\n".join(
        [
            *lines,
            "",
            f"removed of the error that can be removed, adopted: {np.median(parts):.3f} in the median, "
            f"{np.percentile(parts, 5):.3f} in 95%; found anew without a name: {np.median(anew):.3f}, "
            f"{np.percentile(anew, 5):.3f}; larger than 1.02 of before: {worse} of {len(further)}",
            f"parameters inside their intervals: {inside} of {stated} ({100 * inside / stated:.1f}%)",
        ]
    )


def main() -> None:
    """Adopt and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.adoption", description=__doc__)
    parser.add_argument("--seeds", choices=sorted(_SEEDS), default="development")
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--verbose", action="store_true", help="every further unit too")
    given = parser.parse_args()
    first = _SEEDS[given.seeds][_FIRST]
    found = []
    with ProcessPoolExecutor(given.workers) as pool:
        for each in pool.map(outcome, range(first, first + given.count)):
            found.append(each)
            if given.verbose:
                print(row(each), *each.further, *each.lacking, sep="\n", flush=True)
    print(report(found))


if __name__ == "__main__":
    main()
