"""Parameters that are not identifiable after all, once it is known what else is in the table."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from tumble.calibrations.methods.dividing_head.loop.augmented import augment
from tumble.calibrations.methods.dividing_head.loop.table import DividingHeadTable
from tumble.calibrations.methods.dividing_head.model import PARAMETERS
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing.explained import unless_rivals_differ
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.trace import Trace


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


def without_alike(
    calibration: Calibration, base: DividingHeadTable, trace: Trace, others: Sequence[Trace]
) -> Calibration:
    """Take back the parameters that depend on what structure without a name follows, where the rows do not tell."""
    parameters = dict(calibration.parameters)
    for other in others:
        theta = augment(base.with_components(other.components), other).joint.fit.theta
        first, second = (each.components[0].described for each in (trace, other))
        for index, parameter in enumerate(PARAMETERS):
            parameters[parameter] = unless_rivals_differ(parameters[parameter], float(theta[index]), first, second)
    return replace(calibration, parameters=parameters)
