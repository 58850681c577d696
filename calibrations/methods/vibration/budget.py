"""What the reference adds to the uncertainty of the coefficients (GUM, type B)."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.budget import BudgetLine, not_included, with_type_b
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.messages import Message

_POWERS: Final = {"reference_scale": 2.0, "output_scale": 1.0}
"""Relative change of every coefficient for a relative error: the mean square goes with the square of the reference."""


@dataclass(frozen=True, kw_only=True)
class VibrationUncertainty:
    """Relative standard uncertainties (type B) that a stand file states; None where it does not."""

    reference_scale: float | None = None
    """Of the scale factor of the reference accelerometer."""
    output_scale: float | None = None
    """Of the channel that reads the unit, and of the scale factor by which its output was divided."""

    @property
    def left_out(self) -> str:
        """That what the stand adds, or a part of it, is not in the stated uncertainty; empty where all of it is."""
        stated = {
            "samplers.reference.gain_uncertainty": self.reference_scale,
            "samplers.unit.gain_uncertainty": self.output_scale,
        }
        nothing = Message(
            "the scale of the reference is not included in the stated uncertainty, and an error of it of 1% makes "
            "every coefficient wrong by 2%; state {keys} in a stand file",
            keys=", ".join(stated),
        )
        return not_included(stated, nothing)

    @property
    def relative(self) -> Mapping[str, float]:
        """Relative standard uncertainty that each source adds to every coefficient, of those above zero."""
        sizes = {"reference_scale": self.reference_scale, "output_scale": self.output_scale}
        return {name: _POWERS[name] * size for name, size in sizes.items() if size}


@dataclass(frozen=True, kw_only=True)
class Budget:
    """On what the uncertainty of a model rests."""

    lines: tuple[BudgetLine, ...] = ()

    def as_json(self) -> dict[str, Any]:
        """Under the key that every method has for it."""
        return {"budget": [line.as_json() for line in self.lines]}


def budgeted(model: ModelFit, dwell_ug: float, stand: VibrationUncertainty) -> tuple[ModelFit, Budget]:
    """A fitted model with what the stand adds to its uncertainty, and the budget of that."""
    told = {name: each for name, each in model.parameters.items() if each.value is not None}
    parameters = {name: _combined(each, stand) for name, each in model.parameters.items()}
    scatter = BudgetLine(
        name=Message("scatter of the data"),
        kind="A",
        symbol=Message("{scatter:.3g} µg a dwell", scatter=dwell_ug),
        contributions={name: each.type_a or 0.0 for name, each in told.items()},
        degrees_of_freedom=min((each.degrees_of_freedom or np.inf for each in told.values()), default=np.inf),
    )
    return replace(model, parameters=parameters), Budget(lines=(scatter, *_lines(told, stand)))


def _lines(told: Mapping[str, Parameter], stand: VibrationUncertainty) -> tuple[BudgetLine, ...]:
    names = {
        "reference_scale": Message("scale of the reference"),
        "output_scale": Message("scale of the output"),
    }
    return tuple(
        BudgetLine(
            name=names[source],
            kind="B",
            symbol=Message("{relative:g} relative, for the coefficient", relative=relative),
            contributions={name: relative * abs(each.value or 0.0) for name, each in told.items()},
            degrees_of_freedom=float("inf"),
        )
        for source, relative in stand.relative.items()
    )


def _combined(parameter: Parameter, stand: VibrationUncertainty) -> Parameter:
    others = [relative * abs(parameter.value or 0.0) for relative in stand.relative.values()]
    return with_type_b(parameter, float(np.linalg.norm(others)))
