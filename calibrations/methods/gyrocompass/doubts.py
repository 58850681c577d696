"""What a table of a gyrocompass is asked about before anything is stated: the units of its angles and its rates.

A turntable that counts the other way cannot be told: rates at -δ are those of the heading 180° - α0.
"""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions, north_rate
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.messages import Message

_BAD: Final = 0.2
"""Rates that miss the earth rate by more than this part of it do not follow the positions as given."""
_BETTER: Final = 0.1
"""Of the misfit, what another reading of the angles must leave at most to be suggested."""
_TIMES: Final = 2.0
"""Further from the earth rate than by this factor, either way, no torquer is: the unit is another."""
_TURN_RAD: Final = 2.0 * np.pi
_FEWEST: Final = 4
"""Dwells from which on there is anything to be asked."""


def doubts(table: GyrocompassTable, fit: GyrocompassFit) -> tuple[str, ...]:
    """Questions that must be answered before heading or drift is stated; none of a table in order."""
    rows = table.observations
    misfit = _rms((table.output - table.declared @ table.model.coefficients(fit.theta))[table.rates])
    if len(rows) < _FEWEST or misfit < _BAD * float(np.max(north_rate(rows.latitude_deg))):
        return ()
    largest = float(np.abs(rows.azimuth_deg).max())
    if largest <= _TURN_RAD + 1e-6 and _left(table, np.rad2deg(rows.azimuth_deg)) < _BETTER * misfit:
        return (
            Message(
                "the rates do not follow the earth rate by these angles, none of which is beyond {largest:.3g}: are "
                "they in radians? Write azimuth_deg in degrees",
                largest=largest,
            ),
        )
    size = _earth_rate_seen(table)
    if not 1.0 / _TIMES < size < _TIMES and _left(table, rows.azimuth_deg) < _BETTER * misfit:
        return (
            Message(
                "the rates turn with {size:.3g} times the earth rate at this latitude: write rate_deg_h in degrees per "
                "hour and latitude_deg in degrees",
                size=size,
            ),
        )
    return ()


def _earth_rate_seen(table: GyrocompassTable) -> float:
    """The part of the earth rate that turns with the pickoff, over that by the latitude; 1 where it is not told."""
    rows = table.observations
    shown = heading_functions(np.deg2rad(rows.azimuth_deg), rows.latitude_deg, table.scene.lean)
    design = np.column_stack([shown, np.ones(len(rows))])
    if np.linalg.matrix_rank(design) < design.shape[1]:
        return 1.0
    return float(np.linalg.norm(np.linalg.lstsq(design, rows.rate_deg_h, rcond=None)[0][:2]))


def _left(table: GyrocompassTable, azimuth_deg: FloatArray) -> float:
    """What heading and drift leave of the rates with other angles, r.m.s."""
    rows: GyrocompassObservations = table.observations
    shown = heading_functions(np.deg2rad(azimuth_deg), rows.latitude_deg, table.scene.lean)
    design = np.column_stack([shown, np.ones(len(rows))])
    return _rms(rows.rate_deg_h - design @ np.linalg.lstsq(design, rows.rate_deg_h, rcond=1e-9)[0])


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
