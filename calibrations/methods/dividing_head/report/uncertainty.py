"""The back of the report: budget, check by propagation of distributions, correlation, comparison with the paper."""

import math
from typing import Any

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import (
    format_concise,
    format_correlation,
    format_number,
)
from tumble.calibrations.methods.dividing_head.report.results import freedom
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.report.budget import Column, compared, reasons
from tumble.messages import Message


def budget(subject: Subject) -> dict[str, Any]:
    """Sources by parameters, what they come to, and the Monte Carlo check beside it."""
    calibration, stated = subject.use.calibration, subject.stated
    columns = [Column(parameter) for parameter in stated]
    checks = compared(stated, calibration.monte_carlo)
    return {
        "heads": [(column.parameter.name, column.unit) for column in columns],
        "lines": [
            (line.name, line.kind, line.symbol, freedom(line.degrees_of_freedom),
             [column.cell(line.contributions.get(column.parameter.name, 0.0)) for column in columns])
            for line in calibration.budget
        ],
        "combined": [column.cell(column.combined) for column in columns],
        "freedom": [freedom(parameter.degrees_of_freedom) for parameter in stated],
        "coverage": [column.coverage for column in columns],
        "expanded": [column.cell(column.expanded) for column in columns],
        "monte_carlo": checks,
        "reasons": reasons(checks),
    }  # fmt: skip


def correlation(subject: Subject) -> dict[str, Any]:
    """The lower triangle of the correlation matrix of the parameters that have a value."""
    names = list(subject.use.calibration.parameters)
    stated = [names.index(parameter.name) for parameter in subject.stated]
    matrix = subject.use.calibration.correlation
    rows = [
        (names[i], [(format_correlation(float(matrix[i, j])), bool(abs(matrix[i, j]) > 0.9 and i != j))
                    for j in stated[: place + 1]])
        for place, i in enumerate(stated)
    ]  # fmt: skip
    return {"names": [names[i] for i in stated], "rows": rows}


def published(subject: Subject) -> dict[str, Any]:
    """Both methods side by side, and what the z flip of the published one leaves out."""
    calibration = subject.use.calibration
    return {
        "rows": [
            (
                parameter.name,
                Message("not identifiable") if parameter.value is None
                else format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit),
                other.reason if other.value is None
                else format_concise(other.value, other.standard_uncertainty, parameter.unit),
                _difference(parameter, other.value),
            )
            for parameter in calibration.parameters.values()
            if (other := calibration.published.get(parameter.name))
        ],
        "flips": _what_flips_leave_out(subject),
    }  # fmt: skip


def _difference(parameter: Parameter, other: float | None) -> str:
    if parameter.value is None or other is None:
        return ""
    difference = other - parameter.value
    negligible = abs(difference) < 1e-6 * (parameter.standard_uncertainty or 0.0)
    return "0" if negligible else format_number(difference, parameter.unit, 2)


def _what_flips_leave_out(subject: Subject) -> str:
    """How far off kz of the published method may be, because its flip takes alpha0 as 0."""
    parameters = subject.use.calibration.parameters
    scale, angle = parameters["kx"].value, parameters["alpha0"].interval_95
    other = subject.use.calibration.published.get("kz")
    if scale is None or other is None or other.value is None:
        return ""
    reach_deg = 1.0 if angle is None else max(abs(angle[0]), abs(angle[1]))
    amount = format_number(abs(scale) * math.sin(math.radians(reach_deg)), "V/g", 2)
    known = (
        Message("for each degree of alpha0")
        if angle is None
        else Message("for alpha0 at the end of its interval, {reach_deg:.2g}°", reach_deg=reach_deg)
    )
    return Message(
        "The z flip of the published method takes alpha0 as 0: its kz is off by kx sin(alpha0), {amount} {known}.",
        amount=amount,
        known=known,
    )
