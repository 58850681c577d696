"""What is shown of vibrated dwells, the answer first."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from markupsafe import Markup

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.vibration.budget_sections import budget_section
from tumble.calibrations.methods.vibration.line import Line
from tumble.calibrations.methods.vibration.loop import VibrationLoop
from tumble.calibrations.methods.vibration.shown import Shown, shown
from tumble.calibrations.tracing.sentences import findings, unexplained_sentence
from tumble.messages import Message


def sections(loop: VibrationLoop) -> Iterator[Section]:
    """What is shown of a table of vibrated dwells."""
    return _composed(loop, _parameters(loop))


def sections_beside_values(loop: VibrationLoop) -> Iterator[Section]:
    """The same where the values to use are shown anyway: before and after, one by one, are details then."""
    return _composed(loop, replace(_parameters(loop), brief=False))


def _composed(loop: VibrationLoop, parameters: Section) -> Iterator[Section]:
    beside = shown(loop)
    yield _traced(loop)
    yield parameters
    yield _errors(loop)
    yield Section(title=Message("What to measure next"), lines=[each.why for each in loop.experiments], brief=True)
    yield _lines(beside)
    yield _bands(beside)
    yield budget_section(loop)


def _parameters(loop: VibrationLoop) -> Section:
    before, after = loop.declared.parameters, loop.augmented.parameters
    return Section(
        title=Message("Parameters"),
        lines=[each.remark for each in after.values() if each.remark],
        headings=(Message("Parameter"), Message("Declared model"), Message("With what was found")),
        rows=[
            (name, _value(before[name]) if name in before else "", _value(parameter))
            for name, parameter in after.items()
        ],
        brief=True,
    )


def _value(parameter: Parameter) -> str:
    if parameter.value is None or parameter.standard_uncertainty is None:
        return Message("not identifiable: {reason}", reason=parameter.reason)
    return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)


def _traced(loop: VibrationLoop) -> Section:
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


def _errors(loop: VibrationLoop) -> Section:
    models = (loop.declared, loop.augmented)
    return Section(
        title=Message("Before and after"),
        lines=(Message("Held out are whole settings, with all their repeats."),),
        headings=("", Message("Declared model"), Message("With what was found")),
        rows=[
            (Message("residual, r.m.s."), *(_ug(model.residual_rms) for model in models)),
            (Message("held-out error, r.m.s."), *(_ug(model.held_out_rms) for model in models)),
        ],
        brief=True,
    )


def _ug(value: float | None) -> str:
    return Message("none") if value is None else format_number(value, "µg")


def _lines(beside: Shown) -> Section:
    """The line of each axis; its intercept and curvature are those that vibration rectified by K_ii would not have."""

    def draw() -> Markup:
        from tumble.calibrations.methods.vibration import figures  # matplotlib takes half a second

        return figures.line_figure(beside.lines)

    return Section(
        title=Message("DC against mean square"),
        figure=draw if beside.lines else None,
        caption=Message("Each dwell less its rest, less what other axes and what was found add; with a parabola."),
        headings=(
            Message("Axis"),
            Message("Slope"),
            Message("Intercept"),
            Message("Curvature"),
            Message("Verdict"),
        ),
        rows=[_line_row(line) for line in beside.lines],
    )


def _line_row(line: Line) -> Sequence[str]:
    curvature = line.curvature_ug_g4
    return (
        line.axis,
        format_concise(*line.slope_ug_g2, "µg/g²"),
        format_concise(*line.intercept_ug, "µg"),
        format_concise(*curvature, "µg/g⁴") if curvature else "—",
        Message("straight through the rest") if line.straight else Message("not straight"),
    )


def _bands(beside: Shown) -> Section:
    def draw() -> Markup:
        from tumble.calibrations.methods.vibration import figures

        return figures.band_figure(beside.bands)

    return Section(
        title=Message("Rectification coefficient by axis and frequency"),
        figure=draw if any(each.low_hz for each in beside.bands) else None,
        caption=Message("By octave band of the drive, with expanded uncertainty (k = 2), with what was found."),
        headings=(Message("Axis"), Message("Band"), Message("Coefficient"), Message("Dwells")),
        rows=[
            (
                each.axis,
                Message("random") if each.low_hz is None else f"{each.low_hz:.0f}–{each.high_hz:.0f} Hz",
                format_concise(each.value, each.standard_uncertainty, "µg/g²"),
                str(each.dwells),
            )
            for each in beside.bands
        ],
    )
