"""The values to use: those of the declared model, or those with what the loop found, without what it withholds."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.verdict import Model as Model
from tumble.calibrations.methods.dividing_head.result import Calibration

if TYPE_CHECKING:
    from tumble.calibrations.methods.dividing_head.loop.loop import Loop


@dataclass(frozen=True, kw_only=True)
class Usable:
    """A calibration whose values may be used, and whose they are."""

    model: Model
    calibration: Calibration


def usable(declared: Calibration, loop: "Loop | None" = None) -> Usable:
    """Choose the values to use: with something found, the augmented model's, else the declared model's.

    A parameter that the loop withholds has no value in either, and the loop's reason. Without a loop nobody asked.
    """
    if loop is None:
        return Usable(model=Model.DECLARED, calibration=declared)
    if loop.effects or loop.unexplained:
        return Usable(model=Model.AUGMENTED, calibration=_consistent(loop.augmented))
    parameters = without_withheld(declared.parameters, loop.augmented.parameters)
    return Usable(model=Model.DECLARED, calibration=_consistent(replace(declared, parameters=parameters)))


def without_withheld(declared: Mapping[str, Parameter], augmented: Mapping[str, Parameter]) -> dict[str, Parameter]:
    """The parameters of the declared model; those to which the augmented one gives no value have none, and why."""
    return {
        name: augmented[name] if name in augmented and augmented[name].value is None else parameter
        for name, parameter in declared.items()
    }


def _consistent(calibration: Calibration) -> Calibration:
    """The same with nothing computed from a value that is withheld."""
    stated = {name for name, parameter in calibration.parameters.items() if parameter.value is not None}
    return replace(
        calibration,
        monte_carlo={name: found for name, found in calibration.monte_carlo.items() if name in stated},
        per_acceleration={name: found for name, found in calibration.per_acceleration.items() if name in stated},
    )
