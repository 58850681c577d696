"""The back of the report: budget, check by propagation of distributions, correlation, comparison with the paper."""

import math
from dataclasses import dataclass
from typing import Any

from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.propagation import TRIALS
from tumble.calibrations.core.quantities import (
    fixed,
    format_concise,
    format_correlation,
    format_interval,
    format_number,
    prefix_exponent,
    prefixed,
    two_digit_places,
)
from tumble.calibrations.methods.dividing_head.report.results import freedom
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.messages import Message

FEW_DEGREES_OF_FREEDOM = 30
_RESOLVED = 3 * math.sqrt(0.025 * 0.975 / TRIALS) / 0.0584
"""Three standard deviations of an end of a simulated interval, in units of u; 0.0584 is the normal density there."""
_FEW, _CURVED = Message("differ: few degrees of freedom"), Message("differ: not linear")
_WHY = {
    _FEW: Message("With few degrees of freedom the ends of both intervals are themselves uncertain."),
    _CURVED: Message(
        "Where the model is not linear over the width of the uncertainty, the stated interval already integrates "
        "over alpha0 and takes its wider side for both; the simulated one shows how lopsided the estimates are."
    ),
}
"""Why the intervals of budget and simulation may differ, and what to do then."""


def budget(subject: Subject) -> dict[str, Any]:
    """Sources by parameters, what they come to, and the Monte Carlo check beside it."""
    calibration, stated = subject.use.calibration, subject.stated
    columns = [_Column(parameter) for parameter in stated]
    checks = [_comparison(p, *calibration.monte_carlo[p.name]) for p in stated if p.name in calibration.monte_carlo]
    return {
        "heads": [(column.parameter.name, column.unit) for column in columns],
        "lines": [
            (line.name, line.kind, line.symbol, freedom(line.degrees_of_freedom),
             [column.cell(line.contributions.get(column.parameter.name, 0.0)) for column in columns])
            for line in calibration.budget
        ],
        "combined": [column.cell(column.combined) for column in columns],
        "freedom": [freedom(parameter.degrees_of_freedom) for parameter in stated],
        "coverage": [f"{coverage_factor(_freedom(parameter)):.2f}" for parameter in stated],
        "expanded": [column.cell(column.expanded) for column in columns],
        "monte_carlo": checks,
        "reasons": [text for why, text in _WHY.items() if any(check["verdict"] == why for check in checks)],
    }  # fmt: skip


@dataclass(frozen=True)
class _Column:
    """How the contributions to one parameter are written: one prefix, and places by its combined uncertainty."""

    parameter: Parameter

    @property
    def combined(self) -> float:
        return self.parameter.standard_uncertainty or 0.0

    @property
    def expanded(self) -> float:
        low, high = self.parameter.interval_95 or (0.0, 0.0)
        return (high - low) / 2

    @property
    def unit(self) -> str:
        return prefixed(self.parameter.unit, self._exponent)

    @property
    def _exponent(self) -> int:
        return prefix_exponent(self.combined, self.parameter.unit)

    def cell(self, contribution: float) -> str:
        """One more place than the uncertainty; what would vanish in it is said to be smaller, or nothing at all."""
        if not self.combined or contribution <= 1e-9 * self.combined:
            return "0"
        places = max(two_digit_places(self.combined) + self._exponent, 0) + 1
        scaled = contribution / 10.0**self._exponent
        return fixed(scaled, places) if scaled >= 0.5 * 10.0**-places else f"< {fixed(10.0**-places, places)}"


def _comparison(parameter: Parameter, spread: float, simulated: tuple[float, float]) -> dict[str, str]:
    """Intervals by the budget and by Monte Carlo, compared as in JCGM 101, 8.1, to one significant digit.

    A difference that the number of trials does not resolve counts as none.
    """
    interval, combined = parameter.interval_95 or (math.nan, math.nan), parameter.standard_uncertainty or math.nan
    half_digit = 0.5 * 10.0 ** math.floor(math.log10(combined)) if combined > 0 else 0.0
    tolerance = max(half_digit, _RESOLVED * combined)
    difference = max(abs(a - b) for a, b in zip(interval, simulated, strict=True))
    return {
        "name": parameter.name,
        "standard": format_number(combined, parameter.unit, 2),
        "interval": format_interval(*interval, parameter.unit),
        "simulated": format_number(spread, parameter.unit, 2),
        "simulated_interval": format_interval(*simulated, parameter.unit),
        "difference": format_number(difference, parameter.unit, 2),
        "tolerance": format_number(tolerance, parameter.unit, 1),
        "verdict": Message("agree") if difference <= tolerance else _why(parameter),
    }


def _freedom(parameter: Parameter) -> float:
    return math.inf if parameter.degrees_of_freedom is None else parameter.degrees_of_freedom


def _why(parameter: Parameter) -> Message:
    return _FEW if _freedom(parameter) < FEW_DEGREES_OF_FREEDOM else _CURVED


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
