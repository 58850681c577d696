"""A table, what it was traced to, and what could stand in its place."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.tracing.beyond import alike
from tumble.calibrations.tracing.judged import Judged
from tumble.calibrations.tracing.penalties import CLOSE
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace, Tracer
from tumble.messages import Message

RIVALS_APART = 2.0
"""A parameter that differs between rivals by more than so many standard uncertainties is not identifiable."""
_T = TypeVar("_T", bound=Table)
_F = TypeVar("_F")


def unless_rivals_differ(parameter: Parameter, other: float, name: str, rival: str) -> Parameter:
    """The parameter; without its value where that differs too far from what it is if the rival of an effect is true."""
    if parameter.value is None or parameter.standard_uncertainty is None:
        return parameter
    if abs(other - parameter.value) <= RIVALS_APART * parameter.standard_uncertainty:
        return parameter
    return parameter.withheld(
        Message(
            "it differs between {name} and {rival}, which this experiment does not clearly tell apart",
            name=name,
            rival=rival,
        )
    )


@dataclass(frozen=True, kw_only=True)
class Explained(Generic[_T, _F]):
    """A table, what it was traced to, and what could stand in its place."""

    judged: Judged[_T]
    best: _F
    """The fit with what was found."""

    @property
    def tracer(self) -> Tracer[_T]:
        """The table with everything that it may be traced to."""
        return self.judged.tracer

    @property
    def trace(self) -> Trace:
        """What it was traced to."""
        return self.judged.trace

    @property
    def near(self) -> Mapping[str, Sequence[Rival]]:
        """Near rivals of each effect of the trace."""
        return self.judged.near

    @property
    def table(self) -> _T:
        """The table."""
        return self.tracer.table

    @cached_property
    def alike(self) -> list[Trace]:
        """The trace with its structure without a name in each other place from which the rows do not part it."""
        return alike(self.tracer, self.trace, self.judged.scan)

    @property
    def close(self) -> dict[str, list[Rival]]:
        """Rivals of each effect that are not distinguishable from it."""
        return {name: [rival for rival in near if rival.behind < CLOSE] for name, near in self.near.items()}
