"""The measures by name."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from benchmarks.bank import Case
from benchmarks.loop import clean, coverage, exactness, sparse, timing
from benchmarks.loop.jobs import Job, Record
from tumble.calibrations.methods.dividing_head.loop.loop import Loop


@dataclass(frozen=True, kw_only=True)
class Measure:
    """What is asked of the analysis: on which tables, what is kept of each, what is printed in the end."""

    wanted: Callable[[range, int | None], list[Job]]
    """From seeds and the number of tables asked for (None: the usual one)."""
    grade: Callable[[Case, Loop], Record]
    report: Callable[[Sequence[Record]], str]
    failures: Callable[[Sequence[Record]], list[str]]
    """A line for each table that went wrong."""


MEASURES: Final[Mapping[str, Measure]] = MappingProxyType(
    {
        module.__name__.rpartition(".")[2]: Measure(
            wanted=module.wanted, grade=module.grade, report=module.report, failures=module.failures
        )
        for module in (exactness, clean, coverage, sparse, timing)
    }
)
