"""How an uncertainty budget and its check by propagation of distributions are written."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.propagation import TRIALS, Simulated
from tumble.calibrations.core.quantities import (
    fixed,
    format_interval,
    format_number,
    prefix_exponent,
    prefixed,
    two_digit_places,
)
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


@dataclass(frozen=True)
class Column:
    """How the contributions to one parameter are written: one prefix, and places by its combined uncertainty."""

    parameter: Parameter

    @property
    def combined(self) -> float:
        """Combined standard uncertainty."""
        return self.parameter.standard_uncertainty or 0.0

    @property
    def expanded(self) -> float:
        """Half of the 95% interval."""
        low, high = self.parameter.interval_95 or (0.0, 0.0)
        return (high - low) / 2

    @property
    def coverage(self) -> str:
        """The factor k for 95%."""
        return f"{coverage_factor(_freedom(self.parameter)):.2f}"

    @property
    def unit(self) -> str:
        """Of the cells."""
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


def compared(stated: Sequence[Parameter], simulated: Mapping[str, Simulated]) -> list[dict[str, str]]:
    """Each parameter by the budget and by simulation; of those that were simulated."""
    return [_comparison(each, *simulated[each.name]) for each in stated if each.name in simulated]


def reasons(checks: Sequence[Mapping[str, str]]) -> list[str]:
    """Why some of them differ, in sentences."""
    return [text for why, text in _WHY.items() if any(check["verdict"] == why for check in checks)]


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
