"""What is shown of vibrated dwells, the answer first."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from tumble.calibrations.core.quantities import format_concise, format_probability
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.vibration.line import Line
from tumble.calibrations.methods.vibration.loop import VibrationLoop
from tumble.calibrations.methods.vibration.shown import Shown, shown
from tumble.calibrations.report.budget_sections import budget_section
from tumble.calibrations.report.figure import Figure
from tumble.calibrations.tracing.loop_sections import errors_section, parameters_section, traced_section
from tumble.calibrations.tracing.sentences import findings
from tumble.messages import Message


def sections(loop: VibrationLoop) -> Iterator[Section]:
    """What is shown of a table of vibrated dwells."""
    return _composed(loop, parameters_section(loop))


def sections_beside_values(loop: VibrationLoop) -> Iterator[Section]:
    """The same where the values to use are shown anyway: before and after, one by one, are details then."""
    return _composed(loop, replace(parameters_section(loop), brief=False))


def _composed(loop: VibrationLoop, parameters: Section) -> Iterator[Section]:
    beside = shown(loop)
    yield traced_section(loop, findings(loop.effects))
    yield parameters
    yield errors_section(loop, Message("Held out are whole settings, with all their repeats."), "µg")
    yield Section(title=Message("What to measure next"), lines=[each.why for each in loop.experiments], brief=True)
    yield _lines(beside)
    yield _bands(beside)
    stated = [parameter for parameter in loop.augmented.parameters.values() if parameter.value is not None]
    yield budget_section(stated, loop.augmented_budget.lines)


def _lines(beside: Shown) -> Section:
    """The line of each axis; its intercept and curvature are those that vibration rectified by K_ii would not have."""

    def draw() -> Figure:
        from tumble.calibrations.methods.vibration import figures

        return figures.line_figure(beside.lines)

    return Section(
        title=Message("DC against mean square"),
        figure=draw if beside.lines else None,
        caption=Message(
            "Each dwell less its rest, less what other axes and what was found add; with a parabola. A line is not "
            "straight where intercept and curvature together differ from zero (F test, 5% for all axes together)."
        ),
        headings=(
            Message("Axis"),
            Message("Slope"),
            Message("Intercept"),
            Message("Curvature"),
            Message("Verdict"),
            "p",
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
        format_probability(line.p_value),
    )


def _bands(beside: Shown) -> Section:
    def draw() -> Figure:
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
