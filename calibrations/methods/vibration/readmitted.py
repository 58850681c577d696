"""Dwells that were set aside as gross errors and are none: what was found, or a rival of it, explains them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.vibration.effects.curved import CURVED
from tumble.calibrations.methods.vibration.fit import VibrationFit, fit_vibration
from tumble.calibrations.methods.vibration.model import COEFFICIENTS
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.scene import VibrationScene
from tumble.calibrations.methods.vibration.table import VibrationTable
from tumble.calibrations.methods.vibration.weights import row_weights
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.quantified import form_in
from tumble.calibrations.tracing.trace import Trace


def still_gross(
    observations: VibrationObservations,
    gross: Sequence[SetAside],
    explained: Explained[VibrationTable, VibrationFit],
) -> tuple[SetAside, ...]:
    """Those of the dwells set aside that neither what was found nor any rival of it explains."""
    table = explained.table
    scene = replace(table.scene, observations=observations, history=observations)
    limit = gross_sigmas(table.rows)
    within = np.zeros(len(observations), dtype=bool)
    for trace in _explanations(explained):
        within |= np.abs(_off(table, scene, trace)) < limit
    readmitted = set(observations.row[within].tolist())
    return tuple(each for each in gross if each.row not in readmitted)


def still_off(gross: Sequence[SetAside], explained: Explained[VibrationTable, VibrationFit]) -> tuple[SetAside, ...]:
    """Those of the dwells set aside that an explanation of all rows, them too, leaves as far off."""
    table, fit = explained.table, explained.best
    off = np.abs(fit.residual) * np.sqrt(table.weights) / fit.dwell
    far = set(table.observations.row[off > gross_sigmas(table.rows)].tolist())
    something = explained.trace.names or explained.trace.components
    return tuple(each for each in gross if each.row in far or not something)


def _explanations(explained: Explained[VibrationTable, VibrationFit]) -> Iterator[Trace]:
    """What was found and what it could be as well, as far as it says anything of other rows."""
    rivals = (rival.trace for found in explained.close.values() for rival in found)
    for trace in (explained.trace, *rivals):
        if trace.found and not trace.components:
            yield trace


def _off(table: VibrationTable, scene: VibrationScene, trace: Trace) -> FloatArray:
    """How far each dwell is from an explanation, in its standard deviations, shape (rows,)."""
    fit = fit_vibration(table, trace)
    expected_ug = table.functions(scene) @ fit.theta
    for item, columns in zip(fit.found, fit.columns, strict=True):
        size = fit.coefficients[columns]
        curved = CURVED.get(str(item.effect.name))
        expected_ug = expected_ug + (
            form_in(scene, item).columns @ size
            if curved is None
            else curved.shares(scene, float(size[0])).added(fit.theta[:COEFFICIENTS])
        )
    off_ug = scene.observations.output_ug - expected_ug
    return np.asarray(off_ug * np.sqrt(row_weights(scene.observations)) / fit.dwell)
