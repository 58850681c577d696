"""Questions on the unit of a temperature: a room at 296 °C is one in kelvin, one at 72 °C may be in °F."""

import numpy as np

from tumble.calibrations.core.screening import SENSORS_DEGC
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.messages import Message

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
    if _KELVIN[0] < np.median(known) <= _KELVIN[1]:
        return Message(
            "{source}: temperature_degC runs {range}; are these kelvin? Write °C",
            source=observations.source,
            range=_range(known),
        )
    return Message(
        "{source}: temperature_degC runs {range}; what unit is that? Write °C",
        source=observations.source,
        range=_range(known),
    )


def fahrenheit(observations: Observations, reference_temperature_degc: float) -> str:
    """Ask about temperatures far from the one to which parameters refer that are a room's in °F; else empty."""
    known = _known(observations)
    if not len(known) or known.min() - reference_temperature_degc < _AWAY_K:
        return ""
    in_degc = (known - 32.0) / 1.8
    if not (_ROOM_DEGC[0] <= in_degc.min() and in_degc.max() <= _ROOM_DEGC[1]):
        return ""
    return Message(
        "{source}: temperature_degC runs {range}, far from the {reference_degc:g} °C to which parameters refer; are "
        "these °F ({in_degc} °C)? Write °C, or give reference_temperature_degC in the stand file",
        source=observations.source,
        range=_range(known),
        reference_degc=reference_temperature_degc,
        in_degc=_range(in_degc),
    )


def _known(observations: Observations) -> np.ndarray:
    column = observations.temperature_degc
    return np.empty(0) if column is None else column[np.isfinite(column)]


def _range(values: np.ndarray) -> str:
    return Message("from {lowest:.4g} to {highest:.4g}", lowest=values.min(), highest=values.max())
