"""Pages on tables that are not of an accelerometer: sections of sentences, a figure and a table each."""

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from tumble.calibrations.report.templates import TEMPLATES


@dataclass(frozen=True, kw_only=True)
class Part:
    """One section of the page."""

    title: str
    lines: Sequence[str] = ()
    figure: Markup | None = None
    caption: str = ""
    headings: Sequence[str] = ()
    rows: Sequence[Sequence[str]] = ()


def page(kind: str, title: str, parts: Sequence[Part], notices: Sequence[str] = ()) -> str:
    """One HTML page that needs nothing else; the same input gives the same text."""
    shown = [part for part in parts if part.lines or part.rows or part.figure]
    return TEMPLATES.get_template("tables_page.html.j2").render(
        kind=kind, title=title, sections=shown, notices=list(notices)
    )
