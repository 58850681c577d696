"""Figures of vibration rectification."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from tumble.calibrations.methods.vibration.bands import BandCoefficient
from tumble.calibrations.methods.vibration.dwells.broadband import spectrum
from tumble.calibrations.methods.vibration.dwells.reduction import ReducedDwell
from tumble.calibrations.methods.vibration.line import Line
from tumble.calibrations.report.drawing import COLOURS, CURVE, INK, MARKERS, WIDE_IN, styled, to_svg
from tumble.messages import Message

_COVERAGE: Final = 2.0
"""Standard uncertainties of an error bar."""
_SAMPLES: Final = 400
"""Of the waveform."""


@styled
def line_figure(lines: Sequence[Line]) -> Markup:
    """DC against mean square of each axis, the points less what other axes and effects add, with its line."""
    figure = Figure(figsize=(WIDE_IN, 3.0), layout="constrained")
    axes = figure.subplots()
    for number, line in enumerate(lines):
        colour = COLOURS[number]
        axes.plot(line.mean_square_g2, line.rectified_ug, MARKERS[number], color=colour, markersize=4, label=line.axis)
        square = np.linspace(0.0, float(line.mean_square_g2.max()), 100)
        curvature = line.curvature_ug_g4[0] if line.curvature_ug_g4 else 0.0
        drawn = line.intercept_ug[0] + line.slope_ug_g2[0] * square + curvature * square**2
        axes.plot(square, drawn, color=colour, linewidth=0.9)
    axes.axhline(0.0, color=INK, linewidth=0.6)
    axes.set_xlabel(Message("mean square along the axis (g²)"))
    axes.set_ylabel(Message("rectified (µg)"))
    axes.legend()
    return to_svg(figure, "dc-against-g2", Message("DC against the mean square of the vibration"))


@styled
def band_figure(bands: Sequence[BandCoefficient]) -> Markup:
    """Coefficient of each axis by octave band, with its expanded uncertainty."""
    figure = Figure(figsize=(WIDE_IN, 2.6), layout="constrained")
    axes = figure.subplots()
    for number, axis in enumerate(dict.fromkeys(each.axis for each in bands)):
        own = [each for each in bands if each.axis == axis and each.low_hz is not None and each.high_hz is not None]
        centre_hz = [float(np.sqrt((each.low_hz or 1.0) * (each.high_hz or 1.0))) for each in own]
        axes.errorbar(
            centre_hz,
            [each.value for each in own],
            [_COVERAGE * each.standard_uncertainty for each in own],
            fmt=MARKERS[number],
            color=COLOURS[number],
            markersize=4,
            capsize=2,
            label=axis,
        )
    axes.set_xscale("log")
    axes.set_xlabel(Message("frequency (Hz)"))
    axes.set_ylabel(Message("coefficient (µg/g²)"))
    axes.legend()
    return to_svg(figure, "vrc", Message("Rectification coefficient by axis and frequency band"))


@styled
def dwell_figure(dwell: ReducedDwell) -> Markup:
    """Spectrum of the output and of the reference of a dwell, and the beginning of both."""
    samples = dwell.samples
    figure = Figure(figsize=(WIDE_IN, 2.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    channels = [(Message("output"), samples.output_g, COLOURS[0])]
    channels += [(Message("reference"), each, CURVE) for each in samples.references_g[:1]]
    for name, values, colour in channels:
        frequency_hz, density = spectrum(values, samples.step_s)
        left.loglog(frequency_hz[1:], density[1:], color=colour, linewidth=0.8, label=name)
        first = slice(0, min(_SAMPLES, len(values)))
        right.plot(samples.time_s[first], values[first], color=colour, linewidth=0.8, label=name)
    left.set_xlabel(Message("frequency (Hz)"))
    left.set_ylabel("g²/Hz")
    right.set_xlabel(Message("time (s)"))
    right.set_ylabel("g")
    left.legend()
    return to_svg(figure, f"dwell-{samples.dwell}", Message("Spectrum and beginning of a dwell"))
