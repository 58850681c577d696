"""The uncertainty budget of the coefficients, as it is shown."""

from tumble.calibrations.core.quantities import format_freedom
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.vibration.loop import VibrationLoop
from tumble.calibrations.report.budget import Column
from tumble.messages import Message


def budget_section(loop: VibrationLoop) -> Section:
    """The budget of the coefficients with what was found, one line each."""
    stated = [parameter for parameter in loop.augmented.parameters.values() if parameter.value is not None]
    lines, columns = loop.augmented_budget.lines, [Column(parameter) for parameter in stated]
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
