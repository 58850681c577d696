"""A table seen anew from where its trace found it to be: anchored there, its tilts weighed, its azimuths bent."""

from dataclasses import replace
from typing import Final

import numpy as np
from scipy.special import fdtrc

from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.model import ALPHA0
from tumble.calibrations.methods.gyrocompass.nonlinear import beyond_first_order, lean_of
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable, seen_from
from tumble.calibrations.tracing.explained import Explained

_UNEVEN_P: Final = 0.01
"""Below this rates and tilts scatter otherwise than was taken, and are weighed anew."""
_NEAR_RAD: Final = 5e-3
"""An anchor this near the heading that was found is good to 1e-5 of the earth rate."""
_BENT: Final = 1.0
"""Length beyond which what is of second order in the azimuth matters, in variances of a dwell."""


def seen_anew(explained: Explained[GyrocompassTable, GyrocompassFit]) -> GyrocompassTable | None:
    """The table anchored and weighed by what was found, where that makes a difference; None where it makes none."""
    table, fit = explained.table, explained.best
    tilts = _weight_of_tilts(table, fit)
    anchored = abs(float(fit.theta[ALPHA0] - table.scene.theta[ALPHA0])) < _NEAR_RAD
    scene = replace(table.scene, theta=fit.theta, lean=lean_of(table.scene, fit))
    bent = beyond_first_order(scene, fit)
    if anchored and tilts == 1.0 and np.sum(table.weights * (bent - table.known) ** 2) < _BENT * fit.dwell**2:
        return None
    return seen_from(scene, np.where(table.rates, table.weights, tilts * table.weights), bent)


def _weight_of_tilts(table: GyrocompassTable, fit: GyrocompassFit) -> float:
    """By how much more tilts should weigh beside rates, by what is left of both; 1 where they weigh as they should."""
    if not table.scene.with_tilts:
        return 1.0
    squares = table.weights * fit.residual**2
    rate, tilt = (float(np.mean(squares[its])) for its in (table.rates, ~table.rates))
    freedom = max(table.rows - len(fit.theta) - len(fit.coefficients), 2) / 2.0
    ratio = rate / max(tilt, 1e-300)
    chance = 2.0 * float(fdtrc(freedom, freedom, max(ratio, 1.0 / ratio)))
    return ratio if chance < _UNEVEN_P else 1.0
