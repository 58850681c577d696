"""Later runs held against what earlier ones say of a parameter at their temperature."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.temperature.loop import ParameterLoop, TemperatureLoop
from tumble.calibrations.methods.temperature.scene import RunScene
from tumble.calibrations.methods.temperature.table import Runs
from tumble.calibrations.tracing.quantified import form_in
from tumble.messages import Message

_FAR: Final = 3.0
"""Errors of runs left out; a later run that is further off contradicts the model."""


@dataclass(frozen=True, kw_only=True)
class LaterValue:
    """A parameter of a later run beside what is expected of it, in the unit of its column."""

    parameter: str
    unit: str
    temperature_degc: float
    measured: float
    expected: float
    error: float
    """Root mean square error of runs left out, by the model that is used."""
    beyond: bool
    """Whether its temperature lies beyond those of the earlier runs, where no model is held to anything."""

    @property
    def contradicts(self) -> bool:
        """Whether it is further off than runs left out are."""
        return not self.beyond and abs(self.measured - self.expected) > _FAR * self.error


def later_values(loop: TemperatureLoop, later: Sequence[Runs]) -> tuple[LaterValue, ...]:
    """Every parameter of later runs that the earlier ones have, too."""
    return tuple(
        value for runs in later for each in loop.parameters if each.name in runs.parameters for value in _of(each, runs)
    )


def _of(parameter: ParameterLoop, runs: Runs) -> Iterator[LaterValue]:
    known_degc = parameter.explained.table.runs.temperature_degc
    expected, error = _expected(parameter, runs.temperature_degc)
    for degc, measured, value in zip(
        runs.temperature_degc.tolist(), runs.parameters[parameter.name].tolist(), expected.tolist(), strict=True
    ):
        yield LaterValue(
            parameter=parameter.name,
            unit=parameter.unit,
            temperature_degc=degc,
            measured=measured,
            expected=value,
            error=error,
            beyond=not known_degc.min() - 1.0 <= degc <= known_degc.max() + 1.0,
        )


def _expected(parameter: ParameterLoop, temperature_degc: FloatArray) -> tuple[FloatArray, float]:
    """By what was found; by the best polynomial where that predicts better. With the error of runs left out."""
    held_out = parameter.augmented.held_out_rms
    if held_out is None or parameter.only_describes:
        return _by_polynomial(parameter, temperature_degc), parameter.best_polynomial.held_out_rms
    return _by_what_was_found(parameter, temperature_degc), held_out


def _by_polynomial(parameter: ParameterLoop, temperature_degc: FloatArray) -> FloatArray:
    table = parameter.explained.table
    power = parameter.best_polynomial.power
    fitted = np.polynomial.Polynomial.fit(table.runs.temperature_degc, table.output, power)
    return np.asarray(fitted(temperature_degc))


def _by_what_was_found(parameter: ParameterLoop, temperature_degc: FloatArray) -> FloatArray:
    best, earlier = parameter.explained.best, parameter.explained.table.runs
    scene = _with_later(earlier, temperature_degc).over(earlier)
    added = [
        form_in(scene, item).columns @ best.coefficients[columns]
        for item, columns in zip(best.found, best.columns, strict=True)
    ]
    expected = best.parameters["constant"].value + sum(added, np.zeros(scene.rows))
    return np.asarray(expected[earlier.rows :])


def _with_later(earlier: RunScene, temperature_degc: FloatArray) -> RunScene:
    """Runs with others made after them."""
    count = len(temperature_degc)
    before_degc = np.concatenate([earlier.temperature_degc[-1:], temperature_degc[:-1]])
    hours = earlier.hours
    return replace(
        earlier,
        temperature_degc=np.concatenate([earlier.temperature_degc, temperature_degc]),
        order=np.concatenate([earlier.order, earlier.order.max() + np.arange(1.0, count + 1.0)]),
        direction=np.concatenate(
            [earlier.direction, np.sign(temperature_degc - before_degc).astype(earlier.direction.dtype)]
        ),
        hours=None if hours is None else np.concatenate([hours, np.full(count, hours.max())]),
    )


def later_section(values: Sequence[LaterValue]) -> Section:
    """What is shown of later runs."""
    off = sum(value.contradicts for value in values)
    said = (
        Message.counted(
            "{count} value is further from what the earlier runs say than three times the error of runs left out.",
            "{count} values are further from what the earlier runs say than three times the error of runs left out.",
            count=off,
        )
        if off
        else Message("No value is further from what the earlier runs say than three times the error of runs left out.")
    )
    return Section(
        title=Message("Later runs held against these"),
        lines=(said,),
        headings=(
            Message("Parameter"),
            "°C",
            Message("Measured"),
            Message("Expected"),
            Message("Difference"),
            Message("Error of runs left out"),
            "",
        ),
        rows=[_row(value) for value in values],
        brief=True,
    )


def _row(value: LaterValue) -> tuple[str, ...]:
    numbers = (value.measured, value.expected, value.measured - value.expected, value.error)
    remark = Message("beyond the temperatures") if value.beyond else Message("off") if value.contradicts else ""
    return (
        value.parameter,
        f"{value.temperature_degc:.1f}",
        *(format_number(number, value.unit, 6 if place < 2 else 3) for place, number in enumerate(numbers)),
        remark,
    )


def later_json(values: Sequence[LaterValue]) -> list[dict[str, Any]]:
    """The same for the document."""
    return [
        {
            "parameter": value.parameter,
            "temperature_degC": value.temperature_degc,
            "measured": value.measured,
            "expected": value.expected,
            "held_out_rms": value.error,
            "beyond": value.beyond,
            "contradicts": value.contradicts,
        }
        for value in values
    ]
