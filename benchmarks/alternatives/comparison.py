"""Every method on the same tables, and the table of what came out."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from benchmarks.alternatives.columns import Problem, Regression, problem
from benchmarks.alternatives.grading import aliases_of, exact_by_name, exact_up_to_aliases
from benchmarks.bank import clean, make_table, pairs, singles
from benchmarks.bank.lists import Wanted
from benchmarks.blind.files import write_table
from benchmarks.blind.right import COARSE
from benchmarks.blind.running import tables
from benchmarks.loop.intervals import percent
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.held_out import held_out_parts
from tumble.calibrations.methods.dividing_head.loop.loop import Loop, close_loop
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.table import read_table
from tumble.calibrations.tracing.variables import VARIABLE_WORDS

OURS = "close_loop"
NO_COLUMN = frozenset({"misreading", "bias_random_walk"})
"""Effects that no regression on columns can find."""
_LISTS = ("singles", "pairs", "clean", "unnamed")
_DEPENDS_ON = {str(effect.name): VARIABLE_WORDS[effect.depends_on] for effect in CATALOGUE}


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """A table with what is in it."""

    list_name: str
    observations: Observations
    effects: tuple[str, ...] = ()
    """Of the catalogue."""
    right: frozenset[str] = frozenset()
    """Variables that what has no name may be said to follow, as `depends_on` calls them."""


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a method makes of a table."""

    names: tuple[str, ...] | None
    """Of effects; None of a method that has none."""
    variables: frozenset[str]
    """That it says the residual follows."""
    held_out: float | None
    """Error of settings that are held out, in parts of that of the declared model."""


Method = Callable[[Problem], Answer]


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What one method made of one table."""

    list_name: str
    method: str
    by_name: bool | None
    """None of a method that names nothing."""
    up_to_aliases: bool | None
    anything: bool
    """Whether anything was found."""
    right_variable: bool
    held_out: float | None
    seconds: float


def sheets(seeds: range, count: int) -> Iterator[Sheet]:
    """Tables of each list, at even distances, that a regression has the columns for; those without a name, blind."""
    for list_name, wanted in sample(seeds, count).items():
        for spec, seed in wanted:
            if (case := make_table(spec, seed)) is not None:
                yield Sheet(list_name=list_name, observations=case.observations, effects=tuple(case.truth.effects))
    for _, _, made, rng in tables("unnamed", count, seeds.start):
        if made is not None:
            with TemporaryDirectory() as folder:
                path = Path(folder) / "table.csv"
                write_table(path, made, rng)
                right = frozenset(COARSE.get(name, name) for name in made.right)
                yield Sheet(list_name="unnamed", observations=read_table(path), right=right)


def sample(seeds: range, count: int) -> dict[str, Wanted]:
    """What is asked of the tables that have names, or nothing."""
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


def by_columns(find: Callable[[Regression], NDArray[np.bool_]]) -> Method:
    """A method that chooses columns; of rows that are held out it chooses anew among the others."""

    def chosen(given: Problem, rows: NDArray[np.bool_] | None = None) -> tuple[tuple[str, ...], NDArray[np.intp]]:
        regression = given.regression(rows)
        wanted = find(regression)
        return regression.names(wanted), regression.kept[wanted]

    def answer(given: Problem) -> Answer:
        names, _ = chosen(given)
        return Answer(
            names=names,
            variables=frozenset(_DEPENDS_ON[name] for name in names),
            held_out=held_out(given, lambda out: given.errors(out, chosen(given, ~out)[1])),
        )

    return answer


def held_out(given: Problem, errors: Callable[[NDArray[np.bool_]], NDArray[np.float64]]) -> float:
    """Error of the parts that `close_loop` holds out, over that of the declared model."""
    parts = held_out_parts(given.observations)
    nothing = np.empty(0, dtype=np.intp)
    after = sum(float(np.sum(errors(out) ** 2)) for out in parts)
    return float(np.sqrt(after / sum(float(np.sum(given.errors(out, nothing) ** 2)) for out in parts)))


def compare(drawn: Iterator[Sheet], methods: Mapping[str, Method]) -> Iterator[Outcome]:
    """Grade all methods on all tables."""
    for sheet in drawn:
        start = time.perf_counter()
        loop = close_loop(sheet.observations)
        seconds = time.perf_counter() - start
        aliases = aliases_of(loop.effects)
        yield _ours(sheet, loop, seconds)
        for method, find in methods.items():
            start = time.perf_counter()
            answer = find(problem(sheet.observations))
            yield _graded(sheet, method, answer, aliases, time.perf_counter() - start)


def _graded(sheet: Sheet, method: str, answer: Answer, aliases: Sequence[frozenset[str]], seconds: float) -> Outcome:
    names = answer.names
    return Outcome(
        list_name=sheet.list_name,
        method=method,
        by_name=None if names is None else exact_by_name(sheet.effects, names),
        up_to_aliases=None if names is None else exact_up_to_aliases(sheet.effects, names, aliases),
        anything=bool(answer.variables),
        right_variable=bool(answer.variables & sheet.right),
        held_out=answer.held_out,
        seconds=seconds,
    )


def _ours(sheet: Sheet, loop: Loop, seconds: float) -> Outcome:
    """The outcome of `close_loop`; where names are graded, structure without one counts against it too."""
    names = tuple(effect.name for effect in loop.effects)
    unexplained = loop.unexplained
    before, after = loop.declared.held_out_rms_v, loop.augmented.held_out_rms_v
    return Outcome(
        list_name=sheet.list_name,
        method=OURS,
        by_name=exact_by_name(sheet.effects, names, unexplained),
        up_to_aliases=exact_up_to_aliases(sheet.effects, names, aliases_of(loop.effects), unexplained),
        anything=bool(names) or unexplained is not None,
        right_variable=unexplained is not None and unexplained.depends_on in sheet.right,
        held_out=after / before if before and after else None,
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
        "no name: on a right variable",
        "held-out error, named (worst)",
        "held-out error, no name (worst)",
        "median time",
    )
    counted = {name: sum(one.list_name == name and one.method == OURS for one in outcomes) for name in _LISTS}
    methods = dict.fromkeys(one.method for one in outcomes)
    lines = [f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    lines += [_line(method, [one for one in outcomes if one.method == method]) for method in methods]
    return "\n".join([", ".join(f"{count} {name}" for name, count in counted.items()), "", *lines])


def _line(method: str, outcomes: Sequence[Outcome]) -> str:
    one, two, none, unnamed = ([done for done in outcomes if done.list_name == name] for name in _LISTS)
    cells = [
        method,
        _part([done.by_name for done in one]),
        _part([done.up_to_aliases for done in one]),
        _part([done.by_name for done in two]),
        _part([done.up_to_aliases for done in two]),
        _part([done.anything for done in none]),
        _part([done.right_variable for done in unnamed]),
        _errors([*one, *two]),
        _errors(unnamed),
        f"{np.median([done.seconds for done in outcomes]):.2f} s",
    ]
    return f"| {' | '.join(cells)} |"


def _part(told: Sequence[bool | None]) -> str:
    known = [each for each in told if each is not None]
    return percent(sum(known), len(known))


def _errors(outcomes: Sequence[Outcome]) -> str:
    known = [done.held_out for done in outcomes if done.held_out is not None]
    return f"{np.median(known):.2f} ({max(known):.2f})" if known else "–"
