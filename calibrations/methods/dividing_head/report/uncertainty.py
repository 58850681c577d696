"""The back of the report: budget, check by propagation of distributions, correlation, comparison with the paper."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_freedom, format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.report.budget import Column
from tumble.calibrations.report.budget_sections import simulation_section
from tumble.calibrations.report.correlation import correlation_picture
from tumble.messages import Message


def budget_sections(subject: Subject) -> Iterator[Section]:
    """Sources by parameters, what they come to, and the Monte Carlo check beside it."""
    calibration, stated = subject.use.calibration, subject.stated
    if not stated:
        yield _no_value()
        return
    columns = [Column(parameter) for parameter in stated]
    sources = [
        (line.name, line.kind, line.symbol, format_freedom(line.degrees_of_freedom),
         *(column.cell(line.contributions.get(column.parameter.name, 0.0)) for column in columns))
        for line in calibration.budget
    ]  # fmt: skip
    sums: dict[str, list[str]] = {
        Message("Combined u"): [column.cell(column.combined) for column in columns],
        Message("Effective ν"): [format_freedom(parameter.degrees_of_freedom) for parameter in stated],
        Message("k for 95%"): [column.coverage for column in columns],
        Message("Expanded U"): [column.cell(column.expanded) for column in columns],
    }
    yield Section(
        title="",
        caption=Message(
            "Standard uncertainty from each source, in the unit at the head of the column (GUM 5.1.2). Type A comes "
            "from the data, type B from the stand file."
        ),
        headings=(
            Message("Source"),
            Message("Type"),
            Message("Size"),
            "ν",
            *(f"{column.parameter.name} {column.unit}" for column in columns),
        ),
        rows=[*sources, *((name, "", "", "", *cells) for name, cells in sums.items())],
    )
    yield replace(
        simulation_section(stated, calibration.monte_carlo),
        caption=Message(
            "The budget against simulated calibrations (JCGM 101). The intervals agree where their ends differ by no "
            "more than half a unit of the first digit of u (8.1) or than the trials resolve."
        ),
    )


def correlation_sections(subject: Subject) -> Iterator[Section]:
    """Correlation of the parameters that have a value."""
    calibration, stated = subject.use.calibration, [parameter.name for parameter in subject.stated]
    if not stated:
        yield _no_value()
        return
    places = [list(calibration.parameters).index(name) for name in stated]
    yield Section(
        title="",
        figure=lambda: correlation_picture(stated, calibration.correlation[np.ix_(places, places)]),
        caption=Message("Correlation coefficients of the combined uncertainty, types A and B."),
    )


def _no_value() -> Section:
    return Section(title="", lines=[Message("No parameter has a value.")])


def published_sections(subject: Subject) -> Iterator[Section]:
    """Both methods side by side, and what the z flip of the published one leaves out."""
    calibration = subject.use.calibration
    flips = _what_flips_leave_out(subject)
    yield Section(
        title="",
        lines=[
            Message(
                "The same rows by the equations of Avrutov, Bondar and Meleshko (2008), (4) to (18), realisation by "
                "realisation."
            ),
            *([flips] if flips else []),
        ],
        caption=Message(
            "Standard uncertainties in brackets; those of the published method come from the spread between "
            "realisations alone."
        ),
        headings=(Message("Parameter"), Message("This analysis"), Message("Published method"), Message("Difference")),
        rows=[
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
    )  # fmt: skip


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
