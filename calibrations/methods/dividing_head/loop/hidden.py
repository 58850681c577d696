"""Values that rest on the absence of an effect which the rows cannot show."""

from collections.abc import Collection, Sequence
from dataclasses import replace

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.unseen import MATERIAL, Unseen, unseen
from tumble.messages import Message


def resting_on_absence(calibration: Calibration, named: Collection[str]) -> Calibration:
    """The same parameters, conditional where an effect that is not `named` may be there unseen and move them far."""
    hidden = [each for each in unseen(calibration) if each.effect not in named]
    parameters = {name: _conditional(parameter, hidden) for name, parameter in calibration.parameters.items()}
    return replace(calibration, parameters=parameters)


def _conditional(parameter: Parameter, hidden: Sequence[Unseen]) -> Parameter:
    if parameter.value is None or parameter.condition:
        return parameter
    far = MATERIAL * (parameter.standard_uncertainty or 0.0)
    moving = [each for each in hidden if abs(each.parameters[parameter.name] - parameter.value) > far]
    if not moving:
        return parameter
    effect = moving[0].effect
    return replace(
        parameter,
        rests_on=effect,
        given={effect: 0.0},
        remark=Message("these rows could hide one that moves it far beyond its interval"),
    )
