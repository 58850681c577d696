"""What is shown of a triad, the answer first."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.budget_sections import budget_sections
from tumble.calibrations.methods.triad.correction import correction
from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.methods.triad.picture_sections import picture_sections
from tumble.calibrations.tracing.sentences import findings, unexplained_sentence
from tumble.messages import Message


def sections(loop: TriadLoop) -> Iterator[Section]:
    """What is shown of a table of a triad."""
    return _composed(loop, _parameters(loop))


def sections_beside_values(loop: TriadLoop) -> Iterator[Section]:
    """The same where the values to use are shown anyway: before and after, one by one, are details then."""
    return _composed(loop, replace(_parameters(loop), brief=False))


def _composed(loop: TriadLoop, parameters: Section) -> Iterator[Section]:
    if loop.doubts:
        yield Section(title=Message("Please check the table"), lines=loop.doubts, brief=True)
        return
    yield _traced(loop)
    yield parameters
    yield _errors(loop)
    yield _scalar(loop)
    yield Section(title=Message("What to measure next"), lines=[each.why for each in loop.experiments], brief=True)
    yield from picture_sections(loop)
    yield from budget_sections(loop)
    constants = correction(loop.best)
    yield Section(
        title=Message("Correction a = C (u - b)"),
        lines=[*constants.as_c().splitlines(), *constants.as_python().splitlines()],
    )


def _parameters(loop: TriadLoop) -> Section:
    return Section(
        title=Message("Parameters"),
        headings=(Message("Parameter"), Message("Declared model"), Message("With what was found")),
        rows=[
            (name, _value(loop.declared.parameters[name]), _value(parameter))
            for name, parameter in loop.augmented.parameters.items()
        ],
        brief=True,
    )


def _traced(loop: TriadLoop) -> Section:
    lines = []
    if unexplained := loop.unexplained:
        lines.append(unexplained_sentence(unexplained))
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
            for each in findings(loop.effects)
        ],
        brief=True,
    )


def _value(parameter: Parameter) -> str:
    if parameter.value is None or parameter.standard_uncertainty is None:
        return Message("not identifiable: {reason}", reason=parameter.reason)
    return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)


def _errors(loop: TriadLoop) -> Section:
    rows: list[Sequence[str]] = [
        (Message("residual, r.m.s."), *(_volts(model.residual_rms) for model in (loop.declared, loop.augmented))),
        (
            Message("held-out error, r.m.s."),
            *(_volts(model.held_out_rms) for model in (loop.declared, loop.augmented)),
        ),
    ]
    return Section(
        title=Message("Before and after"),
        lines=(Message("Held out are whole positions, with all their repeats."),),
        headings=("", Message("Declared model"), Message("With what was found")),
        rows=rows,
        brief=True,
    )


def _volts(value: float | None) -> str:
    return Message("none") if value is None else format_number(value, "V")


def _scalar(loop: TriadLoop) -> Section:
    if loop.scalar is None:
        return Section(title=Message("Scalar fit"))
    mismatch = loop.scalar.mismatch
    deviation = mismatch.standard_deviation_arcsec
    spread = Message(
        "Mismatch |a| - 1: mean {mean}, standard deviation {deviation} with {freedom} degrees of freedom, largest "
        "{largest}. It does not see a rotation of the unit against the stand, nor any error of the stand's angles.",
        mean=format_number(mismatch.mean_arcsec, "″", 2),
        deviation="—" if deviation is None else format_number(deviation, "″", 2),
        freedom=mismatch.degrees_of_freedom,
        largest=format_number(mismatch.largest_arcsec, "″", 2),
    )
    return Section(
        title=Message("Scalar fit"),
        lines=(spread,),
        headings=(Message("Parameter"), Message("Value")),
        rows=[(name, _value(parameter)) for name, parameter in loop.scalar.parameters.items()],
    )
