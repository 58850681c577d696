"""Effects with one coefficient, which has the name of the effect (effects.md)."""

from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import Draw, Family
from benchmarks.blind.world import Acts, Effect, Unit, World

Form = Callable[[World], FloatArray]
"""What one unit of the coefficient does at each row."""

_S_PER_H: Final = 3600.0


def hours(world: World) -> FloatArray:
    """Return the time from the first row, to which linear drifts refer (result.md)."""
    return world.run.time_s / _S_PER_H


def of_size(name: str, acts: Acts, form: Form, coefficient: float) -> Effect:
    """Return the effect with its coefficient."""
    return Effect(
        name=name, acts=acts, amount=lambda world: coefficient * form(world), coefficients={name: coefficient}
    )


def drawn(name: str, acts: Acts, form: Form) -> Draw:
    """Return how the effect is drawn: either sign is as likely."""

    def draw(_run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
        sign = float(rng.choice([-1.0, 1.0]))
        return lambda size: of_size(name, acts, form, sign * size)

    return draw


def given(name: str, acts: Acts, course: FloatArray, spread: float) -> Family:
    """Return an effect of random levels: its course, and the coefficient of one unit of it."""
    return lambda size: Effect(name=name, acts=acts, amount=lambda _: size * course, coefficients={name: size * spread})


def stated(effects: Mapping[str, tuple[Acts, Form]], name: str, values: Mapping[str, Any]) -> Effect | None:
    """Return the effect of a stated coefficient; None where it is not among these."""
    return of_size(name, *effects[name], float(values[name])) if name in effects else None
