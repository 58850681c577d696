"""Setting aside what no instrument can have measured: missing values, an overload, a garbled number."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.geometry import FloatArray
from tumble.calibrations.observations import OVERLOAD_V, Observations, SetAside

_NEEDED = ("angle_deg", "voltage_v", "reference_deg", "velocity_deg_s", "time_s")
"""Columns in which a row must have a number. A missing temperature or scatter leaves the row usable."""
MOST_DEG: Final = 1e6
"""Beyond any head: 2,777 turns."""
MOST_V: Final = 100.0
"""Beyond any accelerometer's output."""
_MOSTLY: Final = 0.5
"""Where more rows than this part are beyond `MOST_V`, the column is in another unit and is asked about."""
_LONE_K: Final = 2.0
_LONE_TIMES: Final = 20.0
"""A temperature that leaves both its neighbours by so much, and so many times their usual difference, is garbled."""
_FEWEST_STEPS: Final = 8
"""Fewer differences do not tell what is usual."""
SENSORS_DEGC: Final = (-100.0, 250.0)
"""Beyond these no sensor at a dividing head reads a temperature."""


def set_aside_bad_rows(observations: Observations) -> Observations:
    """Return the table without the rows that hold no measurement, each listed once in `set_aside` with its reason.

    A row goes if its angle, voltage, reference, velocity or time is not finite, if its voltage is beyond `OVERLOAD_V`,
    if its angle is beyond any head, or if its voltage is beyond any accelerometer where most are not. Single
    temperatures that no sensor reads, and scatters below zero or infinite, are left out of rows that are used.
    """
    reasons: dict[int, str] = {}
    for name in _NEEDED:
        column: FloatArray | None = getattr(observations, name)
        if column is None:
            continue
        bad = ~np.isfinite(column)
        if name == "voltage_v":
            bad |= np.abs(column) > OVERLOAD_V
        for row, value in zip(observations.row[bad].tolist(), column[bad].tolist(), strict=True):
            reasons.setdefault(row, _reason(name, value))
    measured = observations.without(tuple(SetAside(row=row, reason=reason) for row, reason in reasons.items()))
    return _with_likely_scatter(_with_likely_temperatures(measured.without(tuple(_garbled(measured)))))


def _reason(name: str, value: float) -> str:
    if np.isfinite(value):
        return f"overload: {name} is {value:g}"
    return f"{name} is {value}"


def _garbled(observations: Observations) -> Iterator[SetAside]:
    """Rows whose angle or voltage is a number that nothing at a stand can give."""
    angle_deg = observations.angle_deg
    no_angle = np.abs(angle_deg) > MOST_DEG
    for row, value in zip(observations.row[no_angle].tolist(), angle_deg[no_angle].tolist(), strict=True):
        yield SetAside(row=row, reason=f"angle_deg is {value:g}, beyond any head")
    if observations.voltage_v is None:
        return
    no_voltage = (np.abs(observations.voltage_v) > MOST_V) & ~no_angle
    if np.count_nonzero(no_voltage) > _MOSTLY * len(angle_deg):
        return
    for row, value in zip(
        observations.row[no_voltage].tolist(), observations.voltage_v[no_voltage].tolist(), strict=True
    ):
        yield SetAside(row=row, reason=f"gross error: voltage_V is {value:g}, beyond any accelerometer", gross=True)


def _with_likely_temperatures(observations: Observations) -> Observations:
    """The table without single temperatures that no sensor reads; where most are so, the unit is asked about."""
    temperature_degc = observations.temperature_degc
    if temperature_degc is None:
        return observations
    unlikely = (temperature_degc < SENSORS_DEGC[0]) | (temperature_degc > SENSORS_DEGC[1])
    if np.count_nonzero(unlikely) > _MOSTLY * len(temperature_degc):
        return observations
    return _used_without(observations, "temperature_degc", "temperature_degC", unlikely | _alone(temperature_degc))


def _alone(values: FloatArray) -> NDArray[np.bool_]:
    """Which single values, in the order of the rows, lie far to one side of both neighbours; at an end, of two."""
    steps = np.diff(values)
    if len(steps) < _FEWEST_STEPS or not np.isfinite(steps).any():
        return np.zeros(len(values), dtype=bool)
    limit = max(_LONE_K, _LONE_TIMES * float(np.nanmedian(np.abs(steps))))
    before = np.concatenate([[values[0] - values[2]], steps])
    after = np.concatenate([-steps, [values[-1] - values[-3]]])
    far = np.minimum(np.abs(before), np.abs(after)) > limit
    return np.asarray(far & (np.sign(before) == np.sign(after)))


def _with_likely_scatter(observations: Observations) -> Observations:
    """The table without standard deviations within a dwell that are none."""
    scatter_v = observations.voltage_sd_v
    if scatter_v is None:
        return observations
    return _used_without(observations, "voltage_sd_v", "voltage_sd_V", (scatter_v < 0.0) | (scatter_v > MOST_V))


def _used_without(observations: Observations, name: str, column: str, bad: NDArray[np.bool_]) -> Observations:
    """The table with the values left out, and a sentence that says so."""
    if not bad.any():
        return observations
    values: FloatArray = getattr(observations, name)
    others = int(np.count_nonzero(bad)) - 1
    rows = f"row {observations.row[np.argmax(bad)]}" + (f" and likewise in {others} others" if others else "")
    sentence = f"{observations.source}: {column} is {values[np.argmax(bad)]:g} in {rows}; used without it"
    without: dict[str, Any] = {name: np.where(bad, np.nan, values)}
    return replace(observations, **without, warnings=(*observations.warnings, sentence))
