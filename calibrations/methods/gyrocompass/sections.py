"""What is shown of a gyrocompass, the answer first."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.gyrocompass.budget_sections import budget_sections
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.methods.gyrocompass.misreading import MISREADING, misread_text
from tumble.calibrations.methods.gyrocompass.picture_sections import checks, picture_sections
from tumble.calibrations.tracing.sentences import Finding, findings, nothing_looked_for, unexplained_sentence
from tumble.messages import Message


def sections(loop: GyrocompassLoop) -> Iterator[Section]:
    """What is shown of a table of a gyrocompass."""
    return _composed(loop, _parameters(loop))


def sections_beside_values(loop: GyrocompassLoop) -> Iterator[Section]:
    """The same where the values to use are shown anyway: before and after, one by one, are details then."""
    return _composed(loop, replace(_parameters(loop), brief=False))


def _composed(loop: GyrocompassLoop, parameters: Section) -> Iterator[Section]:
    if loop.doubts:
        yield Section(title=Message("Please check the table"), lines=loop.doubts, brief=True)
        return
    yield _traced(loop)
    yield parameters
    yield _errors(loop)
    yield checks(loop)
    yield Section(title=Message("What to measure next"), lines=[each.why for each in loop.experiments], brief=True)
    yield from picture_sections(loop)
    yield from budget_sections(loop)


def _parameters(loop: GyrocompassLoop) -> Section:
    return Section(
        title=Message("Parameters"),
        headings=(Message("Parameter"), Message("Declared model"), Message("With what was found")),
        rows=[
            (name, _value(loop.declared.parameters[name]), _value(parameter))
            for name, parameter in loop.augmented.parameters.items()
        ],
        brief=True,
    )


def _value(parameter: Parameter) -> str:
    if parameter.value is None or parameter.standard_uncertainty is None:
        return Message("not identifiable: {reason}", reason=parameter.reason)
    return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)


def _traced(loop: GyrocompassLoop) -> Section:
    lines = []
    if unexplained := loop.unexplained:
        lines.append(unexplained_sentence(unexplained))
    if reason := loop.not_traced:
        lines.append(nothing_looked_for(reason))
    if not (loop.effects or lines):
        lines.append(Message("Nothing is left that the scatter of the data does not explain."))
    return Section(
        title=Message("To what it was traced"),
        lines=lines,
        headings=(
            Message("Effect"),
            Message("Belongs to"),
            Message("Could also be"),
            Message("Coefficients"),
            "p",
        ),
        rows=[
            (each.name, each.belongs_to, each.also_possible or Message("told apart"), each.coefficients, each.p_value)
            for each in _found(loop)
        ],
        brief=True,
    )


def _found(loop: GyrocompassLoop) -> list[Finding]:
    text = misread_text(loop.misread)
    return [replace(each, coefficients=text) if each.name == MISREADING else each for each in findings(loop.effects)]


def _errors(loop: GyrocompassLoop) -> Section:
    models = (loop.declared, loop.augmented)
    rows: list[Sequence[str]] = [
        (Message("residual, r.m.s."), *(_rate(model.residual_rms) for model in models)),
        (Message("held-out error, r.m.s."), *(_rate(model.held_out_rms) for model in models)),
    ]
    return Section(
        title=Message("Before and after"),
        lines=(Message("Held out are the rates of whole realisations, or of dwells dealt out where these are few."),),
        headings=("", Message("Declared model"), Message("With what was found")),
        rows=rows,
        brief=True,
    )


def _rate(value: float | None) -> str:
    return Message("none") if value is None else format_number(value, "°/h")
