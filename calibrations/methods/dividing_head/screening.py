"""Setting aside what no accelerometer on a head can have given: missing values, an overload, a garbled number."""

from typing import Final

import numpy as np

from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.core.screening import MOSTLY, beyond, used_without, with_likely_temperatures, without_missing
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.messages import Message

MOST_DEG: Final = 1e6
"""Beyond any head: 2,777 turns."""
MOST_V: Final = 100.0
"""Beyond any accelerometer's output."""


def set_aside_bad_rows(observations: Observations) -> Observations:
    """Return the table without the rows that hold no measurement, each listed once in `set_aside` with its reason.

    A row goes if its angle, voltage, reference, velocity or time is not finite, if its voltage is an overload, if its
    angle is beyond any head, or if its voltage is beyond any accelerometer where most are not. Single temperatures that
    no sensor reads, and scatters below zero or infinite, are left out of rows that are used.
    """
    measured = without_missing(observations, overloads=("voltage_v",))
    return _with_likely_scatter(with_likely_temperatures(measured.without(_garbled(measured))))


def _garbled(observations: Observations) -> tuple[SetAside, ...]:
    """Rows whose angle or voltage is a number that nothing at a stand can give."""
    no_angle = np.abs(observations.angle_deg) > MOST_DEG
    aside = beyond(observations, "angle_deg", no_angle, Message("any head"))
    if observations.voltage_v is None:
        return aside
    no_voltage = (np.abs(observations.voltage_v) > MOST_V) & ~no_angle
    if np.count_nonzero(no_voltage) > MOSTLY * len(observations):
        return aside
    return (*aside, *beyond(observations, "voltage_v", no_voltage, Message("any accelerometer"), gross=True))


def _with_likely_scatter(observations: Observations) -> Observations:
    """The table without standard deviations within a dwell that are none."""
    scatter_v = observations.voltage_sd_v
    if scatter_v is None:
        return observations
    return used_without(observations, "voltage_sd_v", (scatter_v < 0.0) | (scatter_v > MOST_V))
