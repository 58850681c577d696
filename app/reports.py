"""Reports on the disk: as a page (HTML) or on paper (PDF), by what the name of the file ends in."""

from pathlib import Path

from tumble.app.files import replacing, write_text
from tumble.app.kinds import Kind, report_kind
from tumble.calibrations.report.document import Report
from tumble.calibrations.report.language import written_in
from tumble.messages import Language


def write(report: Report, path: Path, language: Language) -> None:
    """Write a report in a language. Raises as `tumble.app.files.replacing`."""
    with written_in(language):
        if report_kind(path) is Kind.PDF:
            _write_pdf(report, path)
        else:
            from tumble.calibrations.report.html import html  # jinja2 takes time

            write_text(path, html(report))


def _write_pdf(report: Report, path: Path) -> None:
    from tumble.calibrations.report.pdf import pdf  # typst is large

    with replacing(path, Kind.PDF) as begun:
        begun.write_bytes(pdf(report))
