"""The closed loop on the terminal."""

from collections.abc import Iterable

from rich.console import Console
from rich.table import Table

from tumble.app.closing import Closing
from tumble.app.console import messages, results
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.sentences import (
    Comparison,
    comparisons,
    findings_of,
    headline,
    leaning,
    untold,
)


def show_loop(loop: Loop, console: Console | None = None) -> None:
    """Print what was found, the models before and after, and what cannot be told any more."""
    console = console or results()
    console.print(headline(loop), markup=False)
    if loop.effects:
        console.print(_findings_table(loop))
    if lines := comparisons(loop):
        console.print(_comparison_table(lines))
    for name, reason in untold(loop):
        console.print(f"- {name} is not identifiable: {reason}", markup=False)
    if leans := leaning(loop):
        console.print(f"- {leans}", markup=False)
    for experiment in loop.next_experiment:
        command = f": {experiment.command}" if experiment.command else ""
        aim = f", to tell {' from '.join(experiment.separates[:2])}" if len(experiment.separates) > 1 else ""
        console.print(f"next{aim}{command}", markup=False)
        console.print(f"  {experiment.why}", markup=False)


def tell_closing(closing: Closing) -> None:
    """Say what the last experiment decided, and what is to be run next or why nothing is."""
    console, chain = messages(), closing.chain
    if closing.declined:
        console.print(f"{closing.declined}; it is planned without that", markup=False)
    elif chain.links:
        link = chain.links[-1]
        console.print(f"{link.experiment.programme} decides {link.decision}", markup=False, soft_wrap=True)
        if link.separated:
            console.print(f"  {link.comparison}", markup=False, soft_wrap=True)
    for first, *others in chain.last.disputed:
        console.print(f"{first} is found, which could as well be {series(others, 'or')}", markup=False, soft_wrap=True)
    if chain.ended:
        console.print(chain.why, markup=False, soft_wrap=True)
    elif closing.next:
        minutes = closing.next.stand_time_s / 60
        console.print(f"next: {closing.next.why}; {minutes:.0f} min at the stand", markup=False, soft_wrap=True)


def _findings_table(loop: Loop) -> Table:
    """Effects found, with their rivals and coefficients."""
    table = _table("What was found", "effect", "or", "belongs to", "coefficients (standard uncertainty)", "p")
    for found in findings_of(loop):
        table.add_row(found.name, found.also_possible, found.belongs_to, found.coefficients, found.p_value)
    return table


def _comparison_table(lines: Iterable[Comparison]) -> Table:
    table = _table("Before and after", "", "declared model", "with what was found", "change")
    for line in lines:
        table.add_row(line.name, line.declared, line.augmented, line.change)
    return table


def _table(title: str, *headings: str) -> Table:
    table = Table(title=title, title_justify="left")
    for heading in headings:
        table.add_column(heading, overflow="fold")
    return table
