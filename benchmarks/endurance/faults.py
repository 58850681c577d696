"""Every kind of fault at every kind of step, through the wire: what happened, what was lost, how soon it was safe.

`python -m benchmarks.endurance.faults` runs a small programme on an emulated stand once for every fault, step and pair
of instruments, and prints a table in Markdown. Lost are points that the run had announced as completed and that its
recording does not hold. A run that was stopped is resumed once the fault is over; `resumed` says that it then had every
point of the programme, once.
"""

import argparse
import os
import re
import sys
from collections import Counter
from collections.abc import Iterable
from itertools import product
from typing import Final

from benchmarks.endurance.emulated import Pair
from benchmarks.endurance.fault_runs import SPEED, Case, Result, of_cases
from benchmarks.endurance.kinds import KINDS, Kind
from benchmarks.endurance.moments import MOMENTS
from tumble.app.exits import Exit

PAIRS: Final[tuple[Pair, ...]] = ("serial", "CAN", "plain meter", "Keithley 2000")
_ALWAYS: Final = "dividing head: has no reference; it is homed"
_PLACES: Final = {
    r"\S*run\.mcap": "run.mcap",
    r"127\.0\.0\.1[:&a-z=]*\d+": "HOST:PORT",
    r"after [\d.]+ s;": "after some seconds;",
    r"\d+ complete points?": "some complete points",
    r"point \d+ \([^)]*\)": "point (pose)",
    r"-?[\d.]+ deg when(.*) at -?[\d.]+ deg": r"some angle when\1 at another",
}


def cell(case: Case, result: Result) -> str:
    """What happened, in a few words; what must not happen is bold."""
    words = [
        "went on" if result.status is Exit.GOOD else f"stopped, status {int(result.status)}",
        f"{result.safe_s:.1f} s",
    ]
    remarks = {
        "standstill not read back": not result.read_back,
        "other unit refused": result.resumed is False and case.kind.other_unit,
        "**not resumed**": result.resumed is False and not case.kind.other_unit,
        "**head moves**": not result.standing,
        f"**{result.lost} lost**": result.lost > 0,
        f"**{result.doubled} doubled**": result.doubled > 0,
        "asked by the analysis": any("seated as asked" in said for said in result.sentences),
    }
    return ", ".join([*words, *(remark for remark, holds in remarks.items() if holds)])


def table(pair: Pair, results: dict[Case, Result]) -> str:
    """A table in Markdown: a row for every kind of fault, a column for every kind of step."""
    lines = [f"| fault, {pair} | {' | '.join(MOMENTS)} |", "|---" * (len(MOMENTS) + 1) + "|"]
    for kind in KINDS:
        cells = {
            case.moment: cell(case, result)
            for case, result in results.items()
            if case.pair == pair and case.kind is kind
        }
        if cells:
            lines.append(f"| {kind.name} | {' | '.join(cells.get(moment, '') for moment in MOMENTS)} |")
    return "\n".join(lines)


def sentences(results: dict[Case, Result]) -> str:
    """What was said, once for each kind of fault, with how often."""
    said = Counter(
        f"- {case.kind.name}: {sentence}"
        for case, result in results.items()
        for sentence in {_without_place(sentence) for sentence in result.sentences} - {_ALWAYS}
    )
    return "\n".join(f"{sentence} ({count} times)" for sentence, count in said.items())


def _without_place(sentence: str) -> str:
    """A sentence without what is another one in every run."""
    for pattern, word in _PLACES.items():
        sentence = re.sub(pattern, word, sentence)
    return sentence


def summary(results: dict[Case, Result]) -> str:
    """One line for all."""
    stopped = [result for result in results.values() if result.status is not Exit.GOOD]
    read_back = [result for result in stopped if result.read_back]
    slowest_s = max((result.safe_s for result in read_back), default=0.0)
    return (
        f"{len(results)} faults at a step: {len(results) - len(stopped)} runs went on to their end, "
        f"{len(stopped)} stopped, {len(read_back)} of these with a standstill read back, the slowest "
        f"{slowest_s:.1f} s after the fault; "
        f"{sum(result.lost for result in results.values())} points lost, "
        f"{sum(result.doubled for result in results.values())} doubled"
    )


def is_bad(case: Case, result: Result) -> bool:
    """Whether something happened that must not."""
    resumed = result.resumed is not False or case.kind.other_unit
    unasked = case.kind.device == "operator" and not any("seated as asked" in said for said in result.sentences)
    return bool(
        unasked or result.lost or result.doubled or not result.standing or result.status is Exit.INTERNAL or not resumed
    )


def cases(kinds: Iterable[Kind], speed: float) -> list[Case]:
    """Every fault at every step, with each pair of instruments that can have it."""
    return [
        Case(kind=kind, moment=moment, pair=pair, speed=speed)
        for kind, moment, pair in product(kinds, MOMENTS, PAIRS)
        if pair in kind.pairs
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--speed", type=float, default=SPEED, help="of the stand, times real time")
    parser.add_argument("--kind", default="", help="only the kinds whose name contains this")
    parser.add_argument("--moment", choices=MOMENTS, help="only this step")
    parser.add_argument(
        "--processes", type=int, default=2 * (os.cpu_count() or 1), help="most of the time is spent waiting"
    )
    options = parser.parse_args()
    chosen = [kind for kind in KINDS if options.kind in kind.name]
    wanted = [case for case in cases(chosen, options.speed) if options.moment in (None, case.moment)]
    results = of_cases(wanted, options.processes)
    for pair in PAIRS:
        print(table(pair, results), end="\n\n")
    print(sentences(results), end="\n\n")
    print(summary(results))
    if bad := [case for case, result in results.items() if is_bad(case, result)]:
        sys.exit("\n".join(f"{case.kind.name} at {case.moment}, {case.pair}: went wrong" for case in bad))


if __name__ == "__main__":
    main()
