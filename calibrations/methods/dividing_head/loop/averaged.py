"""Intervals that hold over every explanation near the one that is stated."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.mixtures import Part, interval_95
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.best_alpha0 import ALPHA0_REACH_DEG
from tumble.calibrations.methods.dividing_head.fit import covariance
from tumble.calibrations.methods.dividing_head.joint import Joint
from tumble.calibrations.methods.dividing_head.loop.augmented import augment
from tumble.calibrations.methods.dividing_head.loop.table import DividingHeadTable
from tumble.calibrations.methods.dividing_head.model import ALPHA0, PARAMETERS
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing.neighbours import Neighbour
from tumble.messages import Message

_REACH_DEG: Final = 0.99 * ALPHA0_REACH_DEG
"""An explanation that leaves alpha0 identifiable keeps it within its reach, however skew its likelihood is."""
_MATERIAL: Final = 0.05
"""What widens an interval by less than this part is left out."""


@dataclass(frozen=True, kw_only=True)
class _Fitted:
    """The parameters by one explanation."""

    odds: float
    theta: FloatArray
    deviations: FloatArray
    """By the scatter of the data alone."""


def averaged(
    calibration: Calibration,
    table: DividingHeadTable,
    listed: Sequence[Neighbour],
    meant: Sequence[FloatArray] = (),
) -> Calibration:
    """The same parameters, their uncertainty widened by what other explanations say of them.

    `meant` are values of all parameters, shape (6,), that the explanation which is stated may as well mean.
    """
    fits = [fit for each in listed if (fit := _fitted(table, each)) is not None]
    deviations = np.array([parameter.type_a or 0.0 for parameter in calibration.parameters.values()])
    fits += [_Fitted(odds=1.0, theta=theta, deviations=deviations) for theta in meant]
    parameters = {
        name: _widened(parameter, index, fits) for index, (name, parameter) in enumerate(calibration.parameters.items())
    }
    added = {name: _added(calibration.parameters[name], widened) for name, widened in parameters.items()}
    if not any(added.values()):
        return calibration
    line = BudgetLine(
        name=Message("explanations that fit nearly as well"),
        kind="B",
        symbol=Message.counted("{count} explanation", "{count} explanations", count=len(fits)),
        contributions={name: u for name, u in added.items() if parameters[name].value is not None},
        degrees_of_freedom=float("inf"),
    )
    return replace(calibration, parameters=parameters, budget=(*calibration.budget, line))


def _added(before: Parameter, after: Parameter) -> float:
    """By how much more a standard uncertainty is, in squares."""
    return float(
        np.sqrt(max((after.standard_uncertainty or 0.0) ** 2 - (before.standard_uncertainty or 0.0) ** 2, 0.0))
    )


def _fitted(table: DividingHeadTable, each: Neighbour) -> _Fitted | None:
    """None where the other explanation leaves no alpha0."""
    joint: Joint = augment(table.with_components(each.trace.components), each.trace).joint
    if not joint.fit.alpha0_fitted:
        return None
    spread = covariance(joint.compressed, joint.fit, joint.profile, joint.noise.used_v**2)
    count = len(PARAMETERS)
    return _Fitted(odds=each.odds, theta=joint.fit.theta[:count], deviations=np.sqrt(np.diag(spread)[:count]))


def _widened(parameter: Parameter, index: int, fits: Sequence[_Fitted]) -> Parameter:
    if parameter.value is None or parameter.interval_95 is None or not parameter.type_a:
        return parameter
    parts = [_part(parameter, 1.0, parameter.value, parameter.type_a)]
    parts += [_part(parameter, fit.odds, float(fit.theta[index]), float(fit.deviations[index])) for fit in fits]
    low, high = interval_95(parts, parameter.degrees_of_freedom or 1.0)
    own_low, own_high = parameter.interval_95
    low, high = min(low, own_low), max(high, own_high)
    wider = (high - low) / (own_high - own_low)
    if wider < 1.0 + _MATERIAL:
        return parameter
    uncertainty = wider * (parameter.standard_uncertainty or 0.0)
    return replace(parameter, standard_uncertainty=uncertainty, interval_95=(low, high))


def _part(parameter: Parameter, odds: float, value: float, deviation: float) -> Part:
    """What an explanation says: the interval of the parameter, moved, and wider or narrower by the scatter."""
    assert parameter.value is not None and parameter.interval_95 is not None, "such were left out"
    low, high = parameter.interval_95
    type_a, u = parameter.type_a or 0.0, parameter.standard_uncertainty or 0.0
    ratio = np.sqrt(max(u**2 - type_a**2 + deviation**2, 0.0)) / u
    low, high = value - ratio * (parameter.value - low), value + ratio * (high - parameter.value)
    if parameter.name == PARAMETERS[ALPHA0]:
        low, high = max(low, -_REACH_DEG), min(high, _REACH_DEG)
    return Part(odds=odds, value=value, low=low, high=high)
