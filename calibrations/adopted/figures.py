"""The course of an adopted effect as a figure."""

from markupsafe import Markup

from tumble.calibrations.adopted.effect import AdoptedEffect
from tumble.calibrations.report.drawing import BAND, COLOURS, INK, WIDE_IN, sheet, styled, to_svg
from tumble.messages import Message

_HEIGHT_IN = 2.8


@styled
def course_figure(effect: AdoptedEffect, label: str) -> Markup:
    """Its values with the band of their expanded uncertainty; at places in space, or of labels, one after the other."""
    curve = effect.curve
    figure, (panel,) = sheet(WIDE_IN, _HEIGHT_IN)
    across = curve.knots.places[:, 0] if curve.knots.places.shape[1] == 1 else range(len(curve.values))
    expanded = 2.0 * curve.standard_uncertainty
    panel.axhline(0.0, color=INK, linewidth=0.6)
    panel.fill_between(across, curve.values - expanded, curve.values + expanded, color=BAND, alpha=0.35, linewidth=0)
    line = "-" if curve.knots.on_a_line else ""
    panel.plot(across, curve.values, color=COLOURS[0], linestyle=line, marker="o", markersize=2.5, linewidth=1.2)
    panel.set_xlabel(label)
    panel.set_ylabel(effect.channel_unit)
    return to_svg(figure, f"course-{effect.name}", Message("Course of {name} over its variable", name=effect.name))
