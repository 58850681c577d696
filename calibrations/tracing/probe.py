"""A probe: a short experiment that visits a unit in a way in which a table may not have seen it."""

from typing import Any, Protocol


class Probe(Protocol):
    """What planning needs to know of an experiment; each method has its own."""

    @property
    def programme(self) -> str:
        """Its name."""
        ...

    @property
    def does(self) -> str:
        """What it changes, in words that go after its name."""
        ...

    @property
    def command(self) -> str:
        """What to type to run it; empty where it is not run from here."""
        ...

    @property
    def stand_time_s(self) -> float:
        """Time that it takes."""
        ...

    @property
    def pairs(self) -> bool:
        """Whether it may be planned together with another one where neither tells anything by itself."""
        ...

    def after(self, rows: Any) -> Any:  # noqa: ANN401  # the kind of rows of its method
        """Return a table with the rows that it would add to it."""
        ...
