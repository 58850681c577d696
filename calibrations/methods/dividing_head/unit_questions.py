"""Questions on the unit of a temperature: a room at 296 °C is one in kelvin, one at 72 °C may be in °F."""

import numpy as np

from tumble.calibrations.core.screening import SENSORS_DEGC
from tumble.calibrations.methods.dividing_head.observations import Observations

_KELVIN = (200.0, 500.0)
"""Temperatures of a chamber, -73 to 227 °C, in kelvin."""
_ROOM_DEGC = (15.0, 35.0)
_AWAY_K = 10.0
"""A reference temperature so far from all rows is extrapolated to."""


def kelvin(observations: Observations) -> str:
    """Ask about temperatures that are none in °C; empty where there is nothing to ask."""
    known = _known(observations)
    if not len(known) or SENSORS_DEGC[0] <= np.median(known) <= _KELVIN[0]:
        return ""
    unit = "are these kelvin?" if _KELVIN[0] < np.median(known) <= _KELVIN[1] else "what unit is that?"
    return f"{observations.source}: temperature_degC runs {_range(known)}; {unit} Write °C"


def fahrenheit(observations: Observations, reference_temperature_degc: float) -> str:
    """Ask about temperatures far from the one to which parameters refer that are a room's in °F; else empty."""
    known = _known(observations)
    if not len(known) or known.min() - reference_temperature_degc < _AWAY_K:
        return ""
    in_degc = (known - 32.0) / 1.8
    if not (_ROOM_DEGC[0] <= in_degc.min() and in_degc.max() <= _ROOM_DEGC[1]):
        return ""
    return (
        f"{observations.source}: temperature_degC runs {_range(known)}, far from the {reference_temperature_degc:g} °C "
        f"to which parameters refer; are these °F ({_range(in_degc)} °C)? Write °C, or give "
        "reference_temperature_degC in the stand file"
    )


def _known(observations: Observations) -> np.ndarray:
    column = observations.temperature_degc
    return np.empty(0) if column is None else column[np.isfinite(column)]


def _range(values: np.ndarray) -> str:
    return f"from {values.min():.4g} to {values.max():.4g}"
