"""Dwells that were set aside as gross errors, and that what was found explains after all.

A list of positions that goes where no other dwell was shows an effect for the first time; by the declared model alone
it stands out as a misreading would. And where more than a few stand out, as after a jump, they may be the structure.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.triad.fit import TriadFit, fit_triad
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.methods.triad.table import TriadTable
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.quantified import form_in
from tumble.calibrations.tracing.trace import Trace

MORE_THAN_A_FEW = 4
"""So many dwells may be structure."""


def still_gross(
    observations: TriadObservations, gross: Sequence[SetAside], explained: Explained[TriadTable, TriadFit]
) -> tuple[SetAside, ...]:
    """Those of the dwells set aside that neither what was found nor any rival of it explains."""
    table = explained.table
    scene = table.view(observations, table.scene.theta)
    limit = gross_sigmas(table.rows)
    within = np.zeros(len(observations), dtype=bool)
    for trace in _explanations(explained):
        within |= np.abs(_off(table, scene, trace)).max(axis=1) < limit
    readmitted = set(observations.row[within].tolist())
    return tuple(each for each in gross if each.row not in readmitted)


def still_off(gross: Sequence[SetAside], everything: Explained[TriadTable, TriadFit]) -> tuple[SetAside, ...]:
    """Those of the dwells set aside that an explanation of all dwells, them too, leaves as far off."""
    if not (everything.trace.names or everything.trace.components):
        return tuple(gross)
    table, fit = everything.table, everything.best
    off = np.abs(fit.deviations_v * np.sqrt(table.further_weights)).max(axis=1) / fit.dwell
    far = set(table.observations.row[off > gross_sigmas(table.rows)].tolist())
    return tuple(each for each in gross if each.row in far)


def _explanations(explained: Explained[TriadTable, TriadFit]) -> Iterator[Trace]:
    """What was found and what it could be as well, as far as it says anything of other rows."""
    rivals = (rival.trace for found in explained.close.values() for rival in found)
    for trace in (explained.trace, *rivals):
        if trace.found and not trace.components:
            yield trace


def _off(table: TriadTable, scene: TriadScene, trace: Trace) -> FloatArray:
    """How far each dwell is from an explanation, in standard deviations of its channels, shape (dwells, 3)."""
    fit = fit_triad(table, trace)
    expected_v = table.functions(scene) @ table.model.coefficients(fit.theta)
    for item, columns in zip(fit.found, fit.columns, strict=True):
        expected_v = expected_v + form_in(scene, item).columns @ fit.coefficients[columns]
    off_v = scene.observations.outputs_v - expected_v.reshape(-1, 3)
    return np.asarray(off_v * np.sqrt(table.further_weights) / fit.dwell)
