"""A closed loop as it is shown, whatever its method: parameters, what was found, errors before and after."""

from collections.abc import Sequence
from typing import Any

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.closed import ClosedLoop
from tumble.calibrations.tracing.sentences import Finding, nothing_looked_for, unexplained_sentence
from tumble.messages import Message

Closed = ClosedLoop[Any, Any, Any]


def parameters_section(loop: Closed) -> Section:
    """Each parameter by both models; by one where they say the same."""
    before, after = loop.declared.parameters, loop.augmented.parameters
    headings, rows = beside_each_other(
        (Message("Parameter"),),
        [
            (name, value_text(before[name]) if name in before else "", value_text(parameter))
            for name, parameter in after.items()
        ],
    )
    return Section(
        title=Message("Parameters"),
        lines=[each.remark for each in after.values() if each.remark],
        headings=headings,
        rows=rows,
        brief=True,
    )


def beside_each_other(
    first: Sequence[str], rows: Sequence[tuple[str, ...]]
) -> tuple[Sequence[str], Sequence[tuple[str, ...]]]:
    """Headings and rows of a table whose last two columns are both models; one column where every row says the same."""
    if all(row[-2] == row[-1] for row in rows):
        return (*first, Message("Declared model")), [row[:-1] for row in rows]
    return (*first, Message("Declared model"), Message("With what was found")), rows


def traced_section(loop: Closed, found: Sequence[Finding], not_traced: str = "") -> Section:
    """What was found, or that nothing is left; `not_traced` says why nothing was looked for."""
    lines = []
    if unexplained := loop.unexplained:
        lines.append(unexplained_sentence(unexplained))
    if not_traced:
        lines.append(nothing_looked_for(not_traced))
    if not (found or lines):
        lines.append(Message("Nothing is left that the scatter of the data does not explain."))
    return Section(
        title=Message("To what it was traced"),
        lines=lines,
        headings=(Message("Effect"), Message("Belongs to"), Message("Could also be"), Message("Coefficients"), "p"),
        rows=[
            (each.name, each.belongs_to, each.also_possible or Message("told apart"), each.coefficients, each.p_value)
            for each in found
        ],
        brief=True,
    )


def errors_section(loop: Closed, held_out: str, unit: str) -> Section:
    """Errors by both models, or by one where they are the same; `held_out` says what is held out."""
    before, after = loop.declared, loop.augmented
    headings, rows = beside_each_other(
        ("",),
        [
            (name, _error(each_before, unit), _error(each_after, unit))
            for name, each_before, each_after in (
                (Message("residual, r.m.s."), before.residual_rms, after.residual_rms),
                (Message("held-out error, r.m.s."), before.held_out_rms, after.held_out_rms),
            )
        ],
    )
    title = Message("Before and after") if len(headings) > 2 else Message("Errors of the model")
    return Section(title=title, lines=(held_out,), headings=headings, rows=rows, brief=True)


def value_text(parameter: Parameter) -> str:
    """Value with its standard uncertainty in brackets, or why there is none."""
    if parameter.value is None or parameter.standard_uncertainty is None:
        return Message("not identifiable: {reason}", reason=parameter.reason)
    return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)


def _error(value: float | None, unit: str) -> str:
    return Message("none") if value is None else format_number(value, unit)
