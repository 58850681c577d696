"""Parameters of a method that fits its rows by least squares, averaged over what they may be as well."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol, TypeVar

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.tracing.averaged import Said, averaged
from tumble.calibrations.tracing.changing import Changing, changing
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.courses import Rows
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.neighbours import in_other_shapes, neighbours
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
    others = (*explained.alike, *explained.judged.nearly, *in_other_shapes(explained.tracer, explained.trace))
    listed = neighbours(explained.tracer, explained.trace, explained.near, others)
    met = [(each.component, [*_met(each, explained.best.theta, parameters, values)]) for each in _changing(explained)]
    said = [*(_of(each.odds, refitted(each.trace)) for each in listed), *(each for _, those in met for each in those)]
    after, lines = averaged(parameters, said, {})
    for component, those in met:
        after = {name: _remarked(each, component, those) for name, each in after.items()}
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


def _met(each: Changing, theta: FloatArray, parameters: Mapping[str, Parameter], values: Values) -> Iterator[Said]:
    """The parameters at each place of a course, together as likely as the mean."""
    middle = values(theta)
    stated = {name: (own.value, own.type_a or 0.0) for name, own in parameters.items() if own.value is not None}
    for change in each.changes:
        moved = values(theta + change)
        yield Said(
            odds=1.0 / len(each.changes),
            values={name: value + moved[name] - middle[name] for name, (value, _) in stated.items()},
            deviations={name: deviation for name, (_, deviation) in stated.items()},
        )


def _remarked(parameter: Parameter, component: Component, met: Sequence[Said]) -> Parameter:
    """A parameter that says so where a component changes it by more than its scatter."""
    if parameter.value is None:
        return parameter
    apart = float(np.ptp([each.values[parameter.name] for each in met]))
    if parameter.remark or apart < (parameter.type_a or 0.0):
        return parameter
    remark = Message(
        "it changes with what has no name ({structure}); the interval holds what it is over these rows",
        structure=component.described,
    )
    return replace(parameter, remark=remark)
