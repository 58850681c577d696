"""A report made of the sections of any method, as one HTML page."""

from collections.abc import Sequence

from tumble.calibrations.core.view import Section
from tumble.calibrations.report.templates import templates


def page(kind: str, title: str, sections: Sequence[Section], notices: Sequence[str] = ()) -> str:
    """One HTML page that needs nothing else; the same input gives the same text."""
    shown = [section for section in sections if not section.empty]
    return (
        templates()
        .get_template("sections.html.j2")
        .render(kind=kind, title=title, sections=shown, notices=list(notices))
    )
