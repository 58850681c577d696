"""A report made of the sections of any method, as one HTML page."""

from collections.abc import Sequence

from tumble.calibrations.core.view import Section
from tumble.calibrations.report.language import language as current
from tumble.calibrations.report.language import written_in
from tumble.calibrations.report.templates import templates
from tumble.messages import Language


def page(
    kind: str,
    title: str,
    sections: Sequence[Section],
    notices: Sequence[str] = (),
    language: Language | None = None,
) -> str:
    """One HTML page that needs nothing else; the same input gives the same text.

    It is in a language, or without one in that of `written_in`.
    """
    shown = [section for section in sections if not section.empty]
    template = templates().get_template("sections.html.j2")
    with written_in(language or current()):
        return template.render(kind=kind, title=title, sections=shown, notices=list(notices))
