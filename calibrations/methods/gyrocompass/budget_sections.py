"""The uncertainty budget of a gyrocompass and its check by simulation, as they are shown."""

from collections.abc import Iterator

from tumble.calibrations.core.quantities import format_freedom
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.report.budget import Column, compared, reasons
from tumble.messages import Message


def budget_sections(loop: GyrocompassLoop) -> Iterator[Section]:
    """The budget of heading and drift with what was found, one line each, and the check of it."""
    stated = [parameter for parameter in loop.augmented.parameters.values() if parameter.value is not None]
    lines, columns = loop.augmented_budget.lines, [Column(parameter) for parameter in stated]
    yield Section(
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
    checks = compared(stated, loop.augmented_budget.monte_carlo)
    yield Section(
        title=Message("Check by propagation of distributions"),
        lines=reasons(checks),
        headings=(
            Message("Parameter"),
            Message("u, budget"),
            Message("u, simulated"),
            Message("95% interval, budget"),
            Message("95% interval, simulated"),
            Message("ends differ by"),
            Message("allowed"),
            Message("Verdict"),
        ),
        rows=[tuple(check.values()) for check in checks],
    )
