"""A unit that was left still in one pose: what its output follows; its parameters are not identifiable."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.repeats import SAME_ANGLE_DEG
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.tracing.effect import Variable
from tumble.calibrations.tracing.variables import VARIABLE_WORDS
from tumble.messages import Message

PROCEDURE: Final = "still"
"""What the column `procedure` holds in every row where the unit was left still on purpose."""
ONE_POSE: Final = Message("the unit was left in one pose, in which bias, scale factor and alignment are one number")
_PARTS: Final = 4
_TOGETHER: Final = 0.95
"""Two variables with a larger correlation went together."""
_CLEAR: Final = 5.0


@dataclass(frozen=True, kw_only=True)
class Slope:
    """How the output follows one variable."""

    variable: Variable
    unit: str
    value: float
    """Of the straight line through all rows."""
    standard_uncertainty: float
    """From how the slopes of the quarters of the range differ."""
    first: float
    """Slope in the quarter where the variable is lowest."""
    last: float
    """Slope in the quarter where it is highest."""
    clear: bool
    """Whether the line is more than the scatter of the rows."""

    def as_json(self) -> dict[str, Any]:
        """The slope as the result of the loop has it."""
        return dict(vars(self))

    @property
    def sentence(self) -> str:
        """What it says."""
        value = format_concise(self.value, self.standard_uncertainty, self.unit)
        variable = VARIABLE_WORDS[self.variable]
        if not self.clear:
            return Message(
                "The output does not follow the {variable} by more than it scatters: {value}.",
                variable=variable,
                value=value,
            )
        first, last = (format_number(each, self.unit) for each in (self.first, self.last))
        return Message(
            "The output follows the {variable} by {value} over all, by {first} in the lowest quarter of its "
            "range and by {last} in the highest.",
            variable=variable,
            value=value,
            first=first,
            last=last,
        )


@dataclass(frozen=True, kw_only=True)
class Still:
    """What a table of one pose says."""

    slopes: tuple[Slope, ...]
    together: bool
    """Whether temperature and time went together, so that either may be what the output follows."""

    @property
    def sentences(self) -> list[str]:
        """All of it in words."""
        either = Message("Temperature and time went together: which of the two it follows is not distinguishable.")
        return [slope.sentence for slope in self.slopes] + [either] * self.together


def in_one_pose(observations: Observations) -> bool:
    """Whether the unit was never turned and never seated another way."""
    turned_deg = float(np.ptp(observations.angle_deg)) if len(observations) else 0.0
    return turned_deg < SAME_ANGLE_DEG and len(set(observations.mounts.tolist())) == 1


def on_purpose(observations: Observations) -> bool:
    """Whether the table says so in every row."""
    procedure = observations.procedure
    return procedure is not None and set(procedure.tolist()) == {PROCEDURE}


def stillness(observations: Observations) -> Still | None:
    """What the output of one pose follows; None for more poses than one, or nothing to follow."""
    if not in_one_pose(observations):
        return None
    followed = dict(_followed(observations))
    slopes = tuple(
        slope
        for (name, unit), values in followed.items()
        if (slope := _slope(name, unit, values, observations.output_v))
    )
    return Still(slopes=slopes, together=_went_together(list(followed.values()))) if slopes else None


def _followed(observations: Observations) -> Iterator[tuple[tuple[Variable, str], FloatArray]]:
    """What an output of one pose may follow, with the unit of the slope."""
    if observations.temperature_degc is not None:
        yield ("temperature", "V/K"), observations.temperature_degc
    if observations.time_s is not None:
        yield ("time", "V/h"), (observations.time_s - observations.time_s[0]) / 3600.0


def _slope(variable: Variable, unit: str, values: FloatArray, output_v: FloatArray) -> Slope | None:
    """Slopes over all and in quarters; None where there are too few values to have any."""
    known = np.isfinite(values)
    values, output_v = values[known], output_v[known]
    if len(np.unique(values)) < 2 * _PARTS:
        return None
    order = np.argsort(values, kind="stable")
    quarters = [
        _line(values[part], output_v[part])[0] for part in np.array_split(order, _PARTS) if np.ptp(values[part])
    ]
    value, deviation = _line(values, output_v)
    return Slope(
        variable=variable,
        unit=unit,
        value=value,
        standard_uncertainty=max(float(np.std(quarters, ddof=1)) / np.sqrt(len(quarters)), deviation),
        first=quarters[0],
        last=quarters[-1],
        clear=abs(value) > _CLEAR * deviation,
    )


def _line(values: FloatArray, output_v: FloatArray) -> tuple[float, float]:
    """Slope of the straight line, and its standard deviation by the scatter about it."""
    away = values - values.mean()
    slope = float(away @ output_v / (away @ away))
    left = output_v - output_v.mean() - slope * away
    return slope, float(np.sqrt(left @ left / max(len(values) - 2, 1) / (away @ away)))


def _went_together(followed: list[FloatArray]) -> bool:
    if len(followed) < 2:
        return False
    known = np.isfinite(followed[0]) & np.isfinite(followed[1])
    return bool(abs(np.corrcoef(followed[0][known], followed[1][known])[0, 1]) > _TOGETHER)
