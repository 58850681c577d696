"""Figures of vibration rectification."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.methods.vibration.bands import BandCoefficient
from tumble.calibrations.methods.vibration.dwells.broadband import spectrum
from tumble.calibrations.methods.vibration.dwells.reduction import ReducedDwell
from tumble.calibrations.methods.vibration.line import Line as AxisLine
from tumble.calibrations.report.figure import COLOURS, INK, SHAPES, Axis, Figure, Layer, Line, Marks, Panel, Span
from tumble.messages import Message

_COVERAGE: Final = 2.0
"""Standard uncertainties of an error bar."""
_SAMPLES: Final = 400
"""Of the waveform."""


def line_figure(lines: Sequence[AxisLine]) -> Figure:
    """DC against mean square of each axis, the points less what other axes and effects add, with its line."""
    layers: list[Layer] = [Span(low=0.0, high=0.0, colour=INK, opacity=1.0)]
    for number, line in enumerate(lines):
        square = np.linspace(0.0, float(line.mean_square_g2.max()), 100)
        curvature = line.curvature_ug_g4[0] if line.curvature_ug_g4 else 0.0
        drawn = line.intercept_ug[0] + line.slope_ug_g2[0] * square + curvature * square**2
        colour, shape = COLOURS[number], SHAPES[number]
        layers += [
            Marks(x=line.mean_square_g2, y=line.rectified_ug, colour=colour, shape=shape, size=4.0, label=line.axis),
            Line(x=square, y=drawn, colour=colour, width=0.9),
        ]
    panel = Panel(
        layers=tuple(layers),
        x=Axis(label=Message("mean square along the axis (g²)")),
        y=Axis(label=Message("rectified (µg)")),
    )
    title = Message("DC against the mean square of the vibration")
    return Figure(name="dc-against-g2", description=title, panels=(panel,), height=240.0)


def band_figure(bands: Sequence[BandCoefficient]) -> Figure:
    """Coefficient of each axis by octave band, with its expanded uncertainty."""
    layers = []
    for number, axis in enumerate(dict.fromkeys(each.axis for each in bands)):
        own = [each for each in bands if each.axis == axis and each.low_hz is not None and each.high_hz is not None]
        value = np.array([each.value for each in own])
        reach = _COVERAGE * np.array([each.standard_uncertainty for each in own])
        layers.append(
            Marks(
                x=np.array([float(np.sqrt((each.low_hz or 1.0) * (each.high_hz or 1.0))) for each in own]),
                y=value,
                y_ends=(value - reach, value + reach),
                colour=COLOURS[number],
                shape=SHAPES[number],
                size=4.0,
                label=axis,
            )
        )
    panel = Panel(
        layers=tuple(layers),
        x=Axis(label=Message("frequency (Hz)"), logarithmic=True),
        y=Axis(label=Message("coefficient (µg/g²)")),
    )
    title = Message("Rectification coefficient by axis and frequency band")
    return Figure(name="vrc", description=title, panels=(panel,), height=210.0)


def dwell_figure(dwell: ReducedDwell) -> Figure:
    """Spectrum of the output and of the reference of a dwell, and the beginning of both."""
    samples = dwell.samples
    channels = [(Message("output"), samples.output_g, COLOURS[0])]
    channels += [(Message("reference"), each, INK) for each in samples.references_g[:1]]
    left, right = [], []
    for name, values, colour in channels:
        frequency_hz, density = spectrum(values, samples.step_s)
        left.append(Line(x=frequency_hz[1:], y=density[1:], colour=colour, width=0.8, label=name))
        first = slice(0, min(_SAMPLES, len(values)))
        right.append(Line(x=samples.time_s[first], y=values[first], colour=colour, width=0.8, label=name))
    return Figure(
        name=f"dwell-{samples.dwell}",
        description=Message("Spectrum and beginning of a dwell"),
        panels=(
            Panel(
                layers=tuple(left),
                x=Axis(label=Message("frequency (Hz)"), logarithmic=True),
                y=Axis(label="g²/Hz", logarithmic=True),
            ),
            Panel(layers=tuple(right), x=Axis(label=Message("time (s)")), y=Axis(label="g")),
        ),
        columns=2,
    )
