"""Intervals that hold over every explanation near the one that is stated."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.best_alpha0 import ALPHA0_REACH_DEG
from tumble.calibrations.methods.dividing_head.fit import covariance
from tumble.calibrations.methods.dividing_head.joint import Joint
from tumble.calibrations.methods.dividing_head.loop.augmented import augment
from tumble.calibrations.methods.dividing_head.loop.head_error import remarked
from tumble.calibrations.methods.dividing_head.loop.table import DividingHeadTable
from tumble.calibrations.methods.dividing_head.model import ALPHA0, PARAMETERS
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing import averaged as tracing
from tumble.calibrations.tracing.averaged import Reach, Said
from tumble.calibrations.tracing.neighbours import Neighbour

_REACH_DEG: Final = 0.99 * ALPHA0_REACH_DEG
"""An explanation that leaves alpha0 identifiable keeps it within its reach, however skew its likelihood is."""


def averaged(
    calibration: Calibration,
    table: DividingHeadTable,
    listed: Sequence[Neighbour],
    meant: Sequence[FloatArray],
    reaches: Mapping[str, Reach],
) -> Calibration:
    """The same parameters, their uncertainty widened by what other explanations say of them.

    `meant` are values of all parameters, shape (6,), that the explanation which is stated may as well mean; `reaches`
    how far a parameter may be from any of them.
    """
    said = [each for neighbour in listed if (each := _said(table, neighbour)) is not None]
    deviations = [parameter.type_a or 0.0 for parameter in calibration.parameters.values()]
    said += [_named(1.0, theta, np.array(deviations)) for theta in meant]
    bounds = {PARAMETERS[ALPHA0]: (-_REACH_DEG, _REACH_DEG)}
    parameters, lines = tracing.averaged(calibration.parameters, said, bounds, reaches)
    return replace(calibration, parameters=remarked(parameters, reaches), budget=(*calibration.budget, *lines))


def _said(table: DividingHeadTable, each: Neighbour) -> Said | None:
    """None where the other explanation leaves no alpha0."""
    joint: Joint = augment(table.with_components(each.trace.components), each.trace).joint
    if not joint.fit.alpha0_fitted:
        return None
    spread = covariance(joint.compressed, joint.fit, joint.profile, joint.noise.used_v**2)
    return _named(each.odds, joint.fit.theta, np.sqrt(np.diag(spread)))


def _named(odds: float, theta: FloatArray, deviations: FloatArray) -> Said:
    """The parameters come first; the coefficients after them are left out."""
    return Said(
        odds=odds,
        values=dict(zip(PARAMETERS, theta.tolist(), strict=False)),
        deviations=dict(zip(PARAMETERS, deviations.tolist(), strict=False)),
    )
