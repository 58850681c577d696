"""What a calibration method is (ISO/IEC 17025, 7.2): the rows it reads, its analysis, what it shows and records.

A method is registered by an entry point of the group `tumble.methods`; nothing else in the program names it.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.view import Quantity, Section

if TYPE_CHECKING:
    from tumble.calibrations.records.entry import Entry


class Result(Protocol):
    """What the closed loop on one or more tables says."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences to be read first."""
        ...

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name; empty where the method states none."""
        ...

    def document(self) -> dict[str, Any]:
        """The result as JSON, with its schema, method and version."""
        ...

    def sections(self) -> Sequence[Section]:
        """What is shown of it, the answer first."""
        ...

    def entry(self) -> "Entry":
        """The result as the store takes it."""
        ...


class Method(Protocol):
    """One kind of measurement and its analysis."""

    @property
    def name(self) -> str:
        """Its key in documents, records and recordings."""
        ...

    @property
    def version(self) -> int:
        """Raised whenever the same rows give other numbers."""
        ...

    @property
    def title(self) -> str:
        """What it measures, in words: the heading of its reports."""
        ...

    @property
    def columns(self) -> str:
        """The tables it reads, in words."""
        ...

    @property
    def headline(self) -> str:
        """Name of the parameter that stands for a result in a list; empty for the first that has a value."""
        ...

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:
        """Whether a table is one of its own, by its columns.

        `numbers` are those that hold numbers; None where the rows have not been read yet.
        """
        ...

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:
        """What to ask of a table that is not quite one of its own; empty where it is of another kind altogether."""
        ...

    def close_loop(self, paths: Sequence[Path]) -> Result:
        """Trace tables of one unit, in the order in which they were measured.

        Raises
        ------
        TableError
            Unreadable or malformed.
        ValueError
            More tables than it takes, or rows that it cannot analyse: one sentence.
        """
        ...


@runtime_checkable
class Worded(Protocol):
    """A method that says what its parameters are called where people read them; or a result, where tables name them."""

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """Symbol and words of each parameter, by name."""
        ...
