"""Reports on the disk: as a page (HTML) or on paper (PDF), by what the name of the file ends in."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tumble.app.files import replacing, write_text
from tumble.app.kinds import Kind, report_kind
from tumble.messages import Language

if TYPE_CHECKING:
    from tumble.calibrations.report.document import Report


def write(report: "Report", path: Path, language: Language) -> None:
    """Write a report in a language. Raises as `tumble.app.files.replacing`."""
    put(in_words(report, language), path)


def in_words(report: "Report", language: Language) -> Mapping[str, Any]:
    """What it says in a language."""
    from tumble.calibrations.report.language import written_in
    from tumble.calibrations.report.written import written

    with written_in(language):
        return written(report)


def put(content: Mapping[str, Any], path: Path) -> None:
    """Write a report that is in words. Raises as `tumble.app.files.replacing`."""
    if report_kind(path) is not Kind.PDF:
        from tumble.calibrations.report import page  # jinja2 takes time

        write_text(path, page.html(content))
        return
    from tumble.calibrations.report import paper  # typst is large

    with replacing(path, Kind.PDF) as begun:
        begun.write_bytes(paper.pdf(content))
