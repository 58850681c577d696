"""Every method on the same tables, and the table of what came out."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.alternatives.columns import Regression, regression
from benchmarks.alternatives.grading import aliases_of, exact_by_name, exact_up_to_aliases
from benchmarks.bank import Case, clean, make_table, pairs, singles
from benchmarks.bank.lists import Wanted
from benchmarks.loop.intervals import percent
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.loop import Loop, close_loop

Method = Callable[[Regression], tuple[str, ...]]
OURS = "close_loop"
NO_COLUMN = frozenset({"misreading", "bias_random_walk"})
"""Effects that no regression on columns can find."""


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What one method made of one table."""

    list_name: str
    method: str
    by_name: bool
    up_to_aliases: bool
    anything: bool
    """Whether anything was found."""
    seconds: float


def sample(seeds: range, count: int) -> dict[str, Wanted]:
    """Tables of each list, at even distances, that a regression has the columns for."""
    return {
        "singles": _spread_out(_with_columns(singles(seeds)), count),
        "pairs": _spread_out(_with_columns(pairs(seeds)), count),
        "clean": clean(seeds, count),
    }


def _with_columns(wanted: Wanted) -> Wanted:
    return [(spec, seed) for spec, seed in wanted if not NO_COLUMN & {name for name, _ in spec.effects}]


def _spread_out(wanted: Wanted, count: int) -> Wanted:
    if count >= len(wanted):
        return wanted
    return [wanted[index] for index in np.linspace(0, len(wanted) - 1, count).round().astype(int)]


def compare(lists: Mapping[str, Wanted], methods: Mapping[str, Method]) -> Iterator[Outcome]:
    """Grade all methods on all tables that the designs can show."""
    for list_name, wanted in lists.items():
        for spec, seed in wanted:
            case = make_table(spec, seed)
            if case is not None:
                yield from _graded(list_name, case, methods)


def _graded(list_name: str, case: Case, methods: Mapping[str, Method]) -> Iterator[Outcome]:
    there = case.truth.effects
    start = time.perf_counter()
    loop = close_loop(case.observations)
    seconds = time.perf_counter() - start
    aliases = aliases_of(loop.effects)
    yield _ours(list_name, there, loop, seconds)
    for method, find in methods.items():
        start = time.perf_counter()
        names = find(regression(fit_jointly(case.observations)))
        seconds = time.perf_counter() - start
        yield Outcome(
            list_name=list_name,
            method=method,
            by_name=exact_by_name(there, names),
            up_to_aliases=exact_up_to_aliases(there, names, aliases),
            anything=bool(names),
            seconds=seconds,
        )


def _ours(list_name: str, there: Sequence[str], loop: Loop, seconds: float) -> Outcome:
    """The outcome of `close_loop`; structure without a name counts against it too."""
    names = [effect.name for effect in loop.effects]
    return Outcome(
        list_name=list_name,
        method=OURS,
        by_name=exact_by_name(there, names, loop.unexplained),
        up_to_aliases=exact_up_to_aliases(there, names, aliases_of(loop.effects), loop.unexplained),
        anything=bool(names) or loop.unexplained is not None,
        seconds=seconds,
    )


def report(outcomes: Sequence[Outcome]) -> str:
    """One line for each method."""
    heads = (
        "method",
        "singles: names exact",
        "up to aliases",
        "pairs: names exact",
        "up to aliases",
        "clean: anything found",
        "median time",
    )
    tables = {name: sum(one.list_name == name and one.method == OURS for one in outcomes) for name in _LISTS}
    methods = dict.fromkeys(one.method for one in outcomes)
    lines = [f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    lines += [_line(method, [one for one in outcomes if one.method == method]) for method in methods]
    return "\n".join([", ".join(f"{count} {name}" for name, count in tables.items()), "", *lines])


_LISTS = ("singles", "pairs", "clean")


def _line(method: str, outcomes: Sequence[Outcome]) -> str:
    one, two, none = ([done for done in outcomes if done.list_name == name] for name in _LISTS)
    cells = [
        method,
        percent(sum(done.by_name for done in one), len(one)),
        percent(sum(done.up_to_aliases for done in one), len(one)),
        percent(sum(done.by_name for done in two), len(two)),
        percent(sum(done.up_to_aliases for done in two), len(two)),
        percent(sum(done.anything for done in none), len(none)),
        f"{np.median([done.seconds for done in outcomes]):.2f} s",
    ]
    return f"| {' | '.join(cells)} |"
