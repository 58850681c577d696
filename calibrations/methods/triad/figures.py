"""Figures of a triad."""

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.report.drawing import COLOURS, INK, MARKERS, WIDE_IN, styled, to_svg


@styled
def mismatch_figure(loop: TriadLoop) -> Markup:
    """|a| - 1 of each dwell in the order of the positions, before and after."""
    figure = Figure(figsize=(WIDE_IN, 2.2), layout="constrained")
    axes = figure.subplots()
    rows = loop.observations
    outputs_v = rows.outputs_v
    order = np.argsort(rows.positions, kind="stable")
    axes.axhline(0.0, color=INK, linewidth=0.6)
    for number, (fit, explained_v) in enumerate(
        ((loop.before, np.zeros_like(outputs_v)), (loop.best, loop.explained_v))
    ):
        mismatch = fit.mismatch_arcsec(outputs_v - explained_v)[order]
        axes.plot(
            np.arange(len(rows)), mismatch, MARKERS[2 * number], markersize=3, linestyle="none", color=COLOURS[number]
        )
    axes.set_xlabel("dwell, by position")
    axes.set_ylabel("|a| - 1 (″)")
    return to_svg(figure, "mismatch", "Mismatch of each dwell before and after")
