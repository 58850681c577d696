"""Adopted effects as effects of a catalogue: a method that declares its axes has them sought like any other."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Generic, TypeVar

import numpy as np

from tumble.calibrations.adopted.effect import AdoptedEffect
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.effect import Effect, Form, Quantity
from tumble.messages import Message

Scene = TypeVar("Scene")
SIZE: Final = "size"
"""Key of its only coefficient."""
_EXPECTED: Final = -2.0 * math.log(100.0)
"""Penalty of what comes again with all units that were seen: odds of a hundred to one that this one has it too."""


@dataclass(frozen=True, kw_only=True)
class Adopting(Generic[Scene]):
    """What a method declares of itself so that effects can be adopted in its tables."""

    catalogue: Sequence[Effect[Scene]]
    """Its own effects, whose names are taken."""
    axes: Callable[[Scene], Sequence[Axis]]
    """Channels and variables of a scene."""


def offered(adopted: AdoptedEffect, adopting: Adopting[Scene]) -> Effect[Scene]:
    """An adopted effect as one of a catalogue: one column, its size the coefficient.

    It has no form where a table does not show the variable, or shows it where the course is not known.
    """

    def axis_in(scene: Scene) -> Axis | None:
        return axis_of(adopted, adopting.axes(scene))

    def forms(scene: Scene) -> tuple[Form, ...]:
        axis = axis_in(scene)
        if axis is None:
            return ()
        odds = _EXPECTED if adopted.expected else 0.0
        return (Form(columns=_added(axis, adopted.curve.at(axis.coordinate.values)[:, None]), penalty=odds),)

    def unknown(scene: Scene) -> FloatArray:
        axis = axis_in(scene)
        assert axis is not None, "it has a form in this scene"
        return _added(axis, adopted.curve.unknown_at(axis.coordinate.values))

    return Effect(
        name=adopted.name,
        belongs_to=adopted.belongs_to,
        symbol="a f(v)",
        source=Message.counted(
            "adopted from {count} unit of the laboratory",
            "adopted from {count} units of the laboratory",
            count=len(adopted.units),
        ),
        forms=forms,
        report=_size,
        depends_on=adopted.depends_on,
        expected=adopted.expected,
        unknown=unknown,
    )


def axis_of(adopted: AdoptedEffect, axes: Sequence[Axis]) -> Axis | None:
    """The axis of an effect among those of a table; None where the table does not have it, or goes beyond its curve."""
    axis = next((each for each in axes if each.key == adopted.key), None)
    return None if axis is None or adopted.curve.knots.beyond(axis.coordinate.values).any() else axis


def _added(axis: Axis, course: FloatArray) -> FloatArray:
    """What courses along an axis add to the output, shape (rows, courses)."""
    return np.asarray(axis.channel.gain[:, None] * course)


def _size(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> Mapping[str, Quantity]:
    """The size in those of the mean of the units on which the effect was found."""
    return {SIZE: Quantity(value=float(coefficients[0]), standard_uncertainty=float(covariance[0, 0] ** 0.5), unit="")}
