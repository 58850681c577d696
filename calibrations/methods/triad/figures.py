"""Figures of a triad."""

from typing import Final

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.methods.triad.mismatch import dwell_mismatch, position_mismatch
from tumble.calibrations.methods.triad.model import NAMES
from tumble.calibrations.report.drawing import COLOURS, INK, MARKERS, WIDE_IN, sheet, styled, to_svg
from tumble.messages import Message

_DIVERGING: Final = "RdBu_r"
_EIGHTHS: Final = np.arange(-180, 181, 90)


@styled
def mismatch_figure(loop: TriadLoop) -> Markup:
    """|a| - 1 of each dwell in the order of the positions, before and after."""
    figure = Figure(figsize=(WIDE_IN, 2.2), layout="constrained")
    axes = figure.subplots()
    order = np.argsort(loop.observations.positions, kind="stable")
    axes.axhline(0.0, color=INK, linewidth=0.6)
    for number, mismatch in enumerate(dwell_mismatch(loop)):
        axes.plot(
            np.arange(len(order)),
            mismatch[order],
            MARKERS[2 * number],
            markersize=3,
            linestyle="none",
            color=COLOURS[number],
        )
    axes.set_xlabel(Message("dwell, by position"))
    axes.set_ylabel("|a| - 1 (″)")
    return to_svg(figure, "mismatch", Message("Mismatch of each dwell before and after"))


@styled
def mismatch_map(loop: TriadLoop) -> Markup:
    """Where both axes stood, each position in the colour of its mean mismatch, before and after in one scale."""
    found = position_mismatch(loop)
    figure, panels = sheet(WIDE_IN, 3.4, columns=2)
    most = max(float(np.abs(each).max()) for each in (found.before_arcsec, found.after_arcsec)) or 1.0
    for panel, title, mismatch in (
        (panels[0], Message("declared model"), found.before_arcsec),
        (panels[1], Message("with what was found"), found.after_arcsec),
    ):
        drawn = panel.scatter(
            _within_turn(found.inner_deg),
            _within_turn(found.outer_deg),
            c=mismatch,
            s=90,
            cmap=_DIVERGING,
            vmin=-most,
            vmax=most,
            edgecolors=INK,
            linewidths=0.5,
        )
        panel.set_title(title)
        panel.set_xlabel(Message("inner angle (°)"))
        panel.set_xticks(_EIGHTHS)
    panels[0].set_yticks(_EIGHTHS)
    panels[0].set_ylabel(Message("outer angle (°)"))
    figure.colorbar(drawn, ax=panels, label="|a| - 1 (″)")
    return to_svg(figure, "mismatch-map", Message("Mismatch over the angles of both axes before and after"))


@styled
def correlation_figure(loop: TriadLoop) -> Markup:
    """Correlation of the parameters that the positions tell, with what was found in the model."""
    fit = loop.best
    told = np.flatnonzero(fit.identified)
    covariance = fit.parameter_covariance[np.ix_(told, told)]
    deviation = np.sqrt(np.diag(covariance))
    figure = Figure(figsize=(WIDE_IN * 0.62, WIDE_IN * 0.5), layout="constrained")
    axes = figure.subplots()
    image = axes.imshow(covariance / np.outer(deviation, deviation), cmap=_DIVERGING, vmin=-1.0, vmax=1.0)
    _name(axes, [NAMES[index] for index in told])
    figure.colorbar(image, ax=axes, label=Message("correlation coefficient"))
    return to_svg(figure, "correlation", Message("Correlation of the parameters"))


def _name(axes: Axes, names: list[str]) -> None:
    axes.set_xticks(range(len(names)), names, rotation=60, ha="right")
    axes.set_yticks(range(len(names)), names)
    axes.grid(visible=False)


def _within_turn(angle_deg: FloatArray) -> FloatArray:
    """Above -180° up to 180°."""
    return np.asarray(180.0 - (180.0 - angle_deg) % 360.0)
