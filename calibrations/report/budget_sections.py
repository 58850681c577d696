"""The uncertainty budget of a method's parameters and its check by simulation, as sections."""

from collections.abc import Mapping, Sequence
from typing import Final

from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.propagation import Simulated
from tumble.calibrations.core.quantities import format_freedom
from tumble.calibrations.core.view import Section
from tumble.calibrations.report.budget import Column, compared, reasons
from tumble.messages import Message

_CHECKED: Final = (
    "name",
    "standard",
    "simulated",
    "interval",
    "simulated_interval",
    "difference",
    "tolerance",
    "verdict",
)
_HEADINGS: Final = (
    Message("Parameter"),
    Message("u, budget"),
    Message("u, simulated"),
    Message("95% interval, budget"),
    Message("95% interval, simulated"),
    Message("ends differ by"),
    Message("allowed"),
    Message("Verdict"),
)


def budget_section(stated: Sequence[Parameter], lines: Sequence[BudgetLine]) -> Section:
    """Parameters that have a value, one line each, with what each source contributes (GUM 5.1.2)."""
    columns = [Column(parameter) for parameter in stated]
    return Section(
        title=Message("Uncertainty budget"),
        lines=[
            Message(
                "{name} (type {kind}): {size}, ν = {freedom}",
                name=line.name,
                kind=line.kind,
                size=line.symbol,
                freedom=format_freedom(line.degrees_of_freedom),
            )
            for line in lines
        ],
        headings=(
            Message("Parameter"),
            Message("Unit"),
            *(line.name for line in lines),
            Message("Combined u"),
            Message("Effective ν"),
            Message("k for 95%"),
            Message("Expanded U"),
        ),
        rows=[
            (
                column.parameter.name,
                column.unit,
                *(column.cell(line.contributions.get(column.parameter.name, 0.0)) for line in lines),
                column.cell(column.combined),
                format_freedom(column.parameter.degrees_of_freedom),
                column.coverage,
                column.cell(column.expanded),
            )
            for column in columns
        ],
    )


def simulation_section(stated: Sequence[Parameter], simulated: Mapping[str, Simulated]) -> Section:
    """The same parameters by the budget and by simulated calibrations (JCGM 101, 8.1)."""
    checks = compared(stated, simulated)
    return Section(
        title=Message("Check by propagation of distributions") if checks else "",
        lines=reasons(checks),
        headings=_HEADINGS,
        rows=[tuple(check[key] for key in _CHECKED) for check in checks],
    )
