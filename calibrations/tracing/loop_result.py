"""A closed loop as the result of a method: what is shown, written and recorded of it."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.closed import ClosedLoop
from tumble.calibrations.tracing.sentences import set_aside_section

if TYPE_CHECKING:
    from tumble.calibrations.records.entry import Entry


@dataclass(frozen=True, kw_only=True)
class LoopResult(ABC):
    """Tables of one unit, taken together. Fits `tumble.calibrations.core.method.Result`."""

    loop: ClosedLoop[Any, Any, Any]

    @abstractmethod
    def document(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`."""

    @abstractmethod
    def entry(self) -> "Entry":
        """The result as the store takes it."""

    @abstractmethod
    def shown(self) -> Iterable[Section]:
        """What is shown of the loop, the answer first."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be asked of the table, and what was odd in it."""
        return (*self.loop.doubts, *self.loop.declared_fit.observations.warnings)

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """With what was found."""
        return self.loop.augmented.parameters

    def sections(self) -> Sequence[Section]:
        """The same with the rows that were set aside."""
        rows = self.loop.declared_fit.observations
        return [*self.shown(), set_aside_section(rows.source, rows.set_aside)]
