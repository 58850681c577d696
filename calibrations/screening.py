"""Setting aside rows that hold no measurement: NaN, infinity, an instrument's overload."""

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.observations import OVERLOAD_V, Observations, SetAside

_NEEDED = ("angle_deg", "voltage_v", "reference_deg", "velocity_deg_s", "time_s")
"""Columns in which a row must have a number. A missing temperature or scatter leaves the row usable."""


def set_aside_bad_rows(observations: Observations) -> Observations:
    """Return the table without the rows that hold no measurement, each listed once in `set_aside` with its reason.

    A row goes if its angle, voltage, reference, velocity or time is not finite, or if its voltage is beyond
    `OVERLOAD_V`.
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
    rejected = tuple(SetAside(row=row, reason=reason) for row, reason in reasons.items())
    return observations.without(rejected)


def _reason(name: str, value: float) -> str:
    if np.isfinite(value):
        return f"overload: {name} is {value:g}"
    return f"{name} is {value}"
