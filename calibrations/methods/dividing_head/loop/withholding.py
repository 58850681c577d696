"""Parameters that are not identifiable after all, once it is known what else is in the table."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from tumble.calibrations.methods.dividing_head.effects.unnamed import withheld_by
from tumble.calibrations.methods.dividing_head.loop.augmented import Augmented, augment
from tumble.calibrations.methods.dividing_head.loop.table import DividingHeadTable
from tumble.calibrations.methods.dividing_head.model import PARAMETERS
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing.effect import Structure
from tumble.calibrations.tracing.explained import RIVALS_APART, unless_rivals_differ
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.variables import VARIABLE_WORDS
from tumble.messages import Message

_COURSES = ("time", "temperature", "order", "realisation", "direction")


def without_courses(calibration: Calibration, best: Augmented) -> Calibration:
    """Withhold parameters of which structure without a name has a part of its own: where it is absent is not known."""
    for item in best.found:
        names = withheld_by(item.effect.name, item.form.scanned)
        calibration = _without(calibration, names, Message("it depends on where an unexplained course is zero"))
    u0 = calibration.parameters["u0"]
    if u0.value is None or u0.standard_uncertainty is None:
        return calibration
    for item, columns in zip(best.found, best.columns, strict=True):
        if isinstance(item.effect, Structure) and item.effect.depends_on in _COURSES:
            mean_v = float(np.mean(item.form.columns @ best.coefficients[columns]))
            if abs(mean_v) > RIVALS_APART * u0.standard_uncertainty:
                reason = Message(
                    "it depends on where the unexplained course with {variable} is taken as absent",
                    variable=VARIABLE_WORDS[item.effect.depends_on],
                )
                return _without(calibration, ("u0",), reason)
    return calibration


def _without(calibration: Calibration, names: Sequence[str], reason: str) -> Calibration:
    """Withhold parameters, for a reason."""
    stated = {name: parameter for name in names if (parameter := calibration.parameters[name]).value is not None}
    withheld = {name: parameter.withheld(reason) for name, parameter in stated.items()}
    return replace(calibration, parameters={**calibration.parameters, **withheld})


def without_rivals(
    calibration: Calibration, table: DividingHeadTable, near: Mapping[str, Sequence[Rival]]
) -> Calibration:
    """Withhold the parameters that depend on which of two rivals is true."""
    parameters = dict(calibration.parameters)
    for name, listed in near.items():
        for rival in listed:
            theta = augment(table, rival.trace).joint.fit.theta
            for index, parameter in enumerate(PARAMETERS):
                parameters[parameter] = unless_rivals_differ(
                    parameters[parameter], float(theta[index]), name, rival.name
                )
    return replace(calibration, parameters=parameters)
