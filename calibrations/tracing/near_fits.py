"""Parameters of a method that fits its rows by least squares, averaged over what they may be as well."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol, TypeVar

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.tracing.averaged import Reach, Said, averaged
from tumble.calibrations.tracing.changing import Changing, changing
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.courses import Rows
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.neighbours import every_near
from tumble.calibrations.tracing.trace import Trace
from tumble.messages import Message


class Fit(Protocol):
    """Parameters fitted beside what was found."""

    @property
    def theta(self) -> FloatArray:
        """Parameters as the table's model has them."""
        ...

    @property
    def residual(self) -> FloatArray:
        """Output minus fitted, free of what is known of the components, shape (rows,)."""
        ...

    @property
    def dwell(self) -> float:
        """Standard deviation of a row of weight 1."""
        ...


_F = TypeVar("_F", bound=Fit)
Values = Callable[[FloatArray], Mapping[str, float]]
"""From `theta` to the parameters as they are stated, by name."""


def averaged_over(
    explained: Explained[Any, _F],
    parameters: Mapping[str, Parameter],
    refitted: Callable[[Trace], Mapping[str, Parameter]],
    values: Values,
) -> tuple[dict[str, Parameter], tuple[BudgetLine, ...]]:
    """Parameters whose intervals hold over near explanations, and over what changes them; the line of that in a budget.

    `refitted` gives the parameters by another explanation. A parameter that is the mean of a course says so.
    """
    others = (*explained.alike, *explained.judged.nearly)
    listed = every_near(explained.tracer, explained.trace, explained.near, others)
    said = [_of(each.odds, refitted(each.trace)) for each in listed]
    reached = [(each.component, _reaches(each, explained.best.theta, values)) for each in _changing(explained)]
    after, lines = averaged(parameters, said, {}, _together([reaches for _, reaches in reached]))
    for component, reaches in reached:
        after = {name: _remarked(each, component, reaches.get(name, Reach())) for name, each in after.items()}
    return after, lines


def _of(odds: float, parameters: Mapping[str, Parameter]) -> Said:
    told = {name: each for name, each in parameters.items() if each.value is not None}
    return Said(
        odds=odds,
        values={name: each.value for name, each in told.items() if each.value is not None},
        deviations={name: each.type_a or 0.0 for name, each in told.items()},
    )


def _changing(explained: Explained[Any, _F]) -> list[Changing]:
    trace, best = explained.trace, explained.best
    if not trace.components:
        return []
    table = explained.table.with_components(trace.components)
    slopes = np.asarray(table.declared @ table.model.slopes(best.theta))
    rows = Rows(
        table=table,
        noise=trace.noise,
        columns=np.column_stack([slopes, *(form.columns for form in trace.forms)]),
        residual=best.residual,
        dwell=best.dwell,
    )
    return list(changing(rows, slopes, trace.components))


def _reaches(each: Changing, theta: FloatArray, values: Values) -> dict[str, Reach]:
    """How far the parameters are from what is stated at the places of a course."""
    middle = values(theta)
    at_places = [values(theta + change) for change in each.changes]
    away = {name: [values[name] - own for values in at_places] for name, own in middle.items()}
    return {name: Reach(below=min(0.0, *those), above=max(0.0, *those)) for name, those in away.items()}


def _together(reached: Sequence[Mapping[str, Reach]]) -> dict[str, Reach]:
    """Of several courses at once."""
    names = reached[0] if reached else ()
    return {
        name: Reach(
            below=sum(reaches[name].below for reaches in reached), above=sum(reaches[name].above for reaches in reached)
        )
        for name in names
    }


def _remarked(parameter: Parameter, component: Component, reach: Reach) -> Parameter:
    """A parameter that says so where a component changes it by more than its scatter."""
    if parameter.value is None or parameter.remark or reach.above - reach.below < (parameter.type_a or 0.0):
        return parameter
    remark = Message(
        "it changes with what has no name ({structure}); the interval holds what it is over these rows",
        structure=component.described,
    )
    return replace(parameter, remark=remark)
