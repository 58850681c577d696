"""What a method may bring beside its analysis: samples reduced to rows of its table, and predictions."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.view import Section


class Shown(Protocol):
    """What is shown on the terminal, in a report and as JSON."""

    @property
    def title(self) -> str:
        """What it is, in words: the heading of its report."""
        ...

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences to be read first."""
        ...

    def document(self) -> dict[str, Any]:
        """The same as JSON, with its schema."""
        ...

    def sections(self) -> Sequence[Section]:
        """What is shown of it, the answer first."""
        ...


class Reduced(Shown, Protocol):
    """Samples reduced."""

    def rows(self, mounting: int) -> Rows:
        """The same as rows of the method's table, all of one mounting of the unit."""
        ...


@runtime_checkable
class Reduces(Protocol):
    """A method that reduces files of samples."""

    def are_samples(self, header: Sequence[str]) -> bool:
        """Whether a table with these columns is one of them."""
        ...

    def reduced(self, path: Path) -> Reduced:
        """Reduce a file. Raises `TableError`: unreadable or malformed."""
        ...


@runtime_checkable
class Predicts(Protocol):
    """A method whose result says what a unit does under random vibration of a given spectrum."""

    @property
    def profiles(self) -> Sequence[str]:
        """Names of the spectra that come along."""
        ...

    def predicted(self, paths: Sequence[Path], spectrum: str, axis: str) -> Shown:
        """Predict from tables of one unit; the spectrum by its name or as a file.

        Raises
        ------
        TableError
            Unreadable or malformed.
        ValueError
            Rows that it cannot analyse, or no spectrum of that name.
        """
        ...
