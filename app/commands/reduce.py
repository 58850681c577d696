"""`tumble reduce`: samples of dwells, reduced to means with their uncertainty."""

from pathlib import Path

import click

from tumble.app import reports
from tumble.app.commands import options
from tumble.app.console import warn
from tumble.app.reducing import reduced_file
from tumble.app.sections import show_sections
from tumble.app.terminal import language, say
from tumble.calibrations.core.reducing import Reduced
from tumble.calibrations.core.table import write_table
from tumble.calibrations.report.document import page_of_sections
from tumble.messages import Message


@click.command("reduce")
@click.argument("file", type=options.EXISTING)
@click.option("--table", "table", type=options.TABLE, help="Write the dwells as a table for fit and close-loop (CSV).")
@click.option(
    "--mounting", type=click.IntRange(min=1), default=1, show_default=True, help="Number of the mounting in that table."
)
@options.verbose
@options.json_out
@click.option("--report", "page", type=options.REPORT, help="Write the report (HTML) here.")
def command(
    file: Path, table: Path | None, mounting: int, verbose: bool, json_path: Path | None, page: Path | None
) -> None:
    """Reduce the samples of dwells (CSV): offset, harmonics and frequency fitted together, each against its rest.

    Missing samples, cut periods and a drive off its nominal frequency do no harm. A dwell that is clipped, or in which
    the drive is locked to the sampling clock, has no mean, and it is said why.
    """
    found = reduced_file(file)
    warn(found.warnings)
    if str(json_path) != "-":
        show_sections(found.sections(), verbose=verbose)
    options.write_json(found.document(), json_path)
    if table is not None:
        write_table(found.rows(mounting), table)
        say(Message("table {path}", path=table), err=True)
    if page is not None:
        _write_page(found, file, page)


def _write_page(found: Reduced, file: Path, page: Path) -> None:
    content = page_of_sections(found.title, file.name, list(found.sections()), found.warnings)
    reports.write(content, page, language())
    say(Message("report {page}", page=page), err=True)
