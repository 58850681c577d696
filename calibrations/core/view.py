"""What is shown of a result, the same on the terminal, in the report and in the window."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from markupsafe import Markup


@dataclass(frozen=True, kw_only=True)
class Section:
    """One section: sentences, then a figure, then a table; any of them may be missing."""

    title: str
    lines: Sequence[str] = ()
    figure: Callable[[], Markup] | None = None
    """Draws it as SVG; asked only where it is shown."""
    caption: str = ""
    headings: Sequence[str] = ()
    rows: Sequence[Sequence[str]] = ()
    brief: bool = False
    """Whether it belongs to the answer; the others are details."""

    @property
    def empty(self) -> bool:
        """Whether there is nothing in it."""
        return not (self.lines or self.rows or self.figure)
