"""What is shown of a result, the same on the terminal, in the report and in the window."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol


class Drawn(Protocol):
    """A figure that can be drawn: one described (`tumble.calibrations.report.figure`), or SVG as it is (`Markup`)."""

    def __html__(self) -> str:
        """The figure as an SVG element, in the language of the page that is written."""
        ...


@dataclass(frozen=True, kw_only=True)
class Section:
    """One section: sentences, then a figure, then a table, then code; any of them may be missing."""

    title: str
    lines: Sequence[str] = ()
    figure: Callable[[], Drawn] | None = None
    """Asked only where it is shown."""
    caption: str = ""
    """Of the figure, or without one of the table."""
    headings: Sequence[str] = ()
    rows: Sequence[Sequence[str]] = ()
    code: str = ""
    """To be copied into a programme as it stands; shown last, in letters of one width."""
    brief: bool = False
    """Whether it belongs to the answer; the others are details."""

    @property
    def empty(self) -> bool:
        """Whether there is nothing in it."""
        return not (self.lines or self.rows or self.figure or self.code)


def drawn_first(sections: Sequence[Section]) -> Section | None:
    """The section whose figure stands for all of them: of the answer, or else the first; None where none has one."""
    drawn = [section for section in sections if section.figure]
    return next((section for section in drawn if section.brief), drawn[0] if drawn else None)


@dataclass(frozen=True, kw_only=True)
class Chapter:
    """A part of a report: sections under one heading, their own titles below it."""

    anchor: str
    """By which a link finds it."""
    title: str
    sections: Sequence[Section]


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """What a parameter is called where people read it."""

    symbol: str
    words: str
