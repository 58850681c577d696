"""Dwells that were set aside as gross errors, and that what was found explains after all.

The only dwell that comes from the other side, or stands where no other did, shows an effect for the first time; by the
declared model alone it stands out as a misreading would.
"""

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, HEADING, direction
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable, functions, measured
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.quantified import form_in


def still_gross(
    whole: GyrocompassObservations, explained: Explained[GyrocompassTable, GyrocompassFit]
) -> tuple[SetAside, ...]:
    """Those of the gross errors that were set aside of a table which what was found does not explain."""
    table = explained.table
    gross = [each for each in table.observations.set_aside if each.gross and each.row in whole.row]
    if not gross or not explained.trace.found or explained.trace.components:
        return tuple(gross)
    off = _off(whole, table, explained.best)
    within = set(whole.row[np.abs(off).max(axis=1) < gross_sigmas(table.rows)].tolist())
    return tuple(each for each in gross if each.row not in within)


def _off(whole: GyrocompassObservations, table: GyrocompassTable, fit: GyrocompassFit) -> FloatArray:
    """How far each dwell is from what was found, in standard deviations of its rows, shape (dwells, outputs)."""
    return deviations(whole, table, fit) * np.sqrt(table.further_weights) / fit.dwell


def deviations(rows: GyrocompassObservations, table: GyrocompassTable, fit: GyrocompassFit) -> FloatArray:
    """Rows less what a fit of a table with everything that was found says of them, shape (dwells, outputs)."""
    scene = table.view(rows, fit.theta)
    shown = functions(scene, table.bases)
    expected = shown @ table.model.coefficients(fit.theta)
    expected = expected + shown[:, :HEADING] @ direction(float(table.scene.theta[ALPHA0]))
    for item, columns in zip(fit.found, fit.columns, strict=True):
        expected = expected + form_in(scene, item).columns @ fit.coefficients[columns]
    return np.asarray((measured(scene) - expected).reshape(scene.dwells, -1))
