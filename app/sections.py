"""The sections of a result on the terminal."""

from collections.abc import Iterable

from rich.table import Table

from tumble.app.console import results
from tumble.app.terminal import numeric
from tumble.calibrations.core.view import Section


def show_sections(sections: Iterable[Section], *, verbose: bool = False) -> None:
    """Print the answer, or everything."""
    for section in sections:
        if (verbose or section.brief) and not section.empty:
            _show(section)


def _show(section: Section) -> None:
    console = results()
    for line in section.lines:
        console.print(numeric(line), markup=False, soft_wrap=True)
    if section.rows:
        table = Table(title=section.title, title_justify="left")
        for heading in section.headings:
            table.add_column(heading, overflow="fold")
        for row in section.rows:
            table.add_row(*map(numeric, row))
        console.print(table)
    if section.code:
        console.print(section.code, markup=False, soft_wrap=True, highlight=False, end="")
