"""What is shown of a triad that was taken to several temperatures: its parameters at each of them."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.by_temperature import AtTemperature, at_each_temperature
from tumble.calibrations.methods.triad.model import NAMES
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.report.figure import COLOURS, SHAPES, Axis, Figure, Layer, Line, Marks, Panel
from tumble.calibrations.tracing.loop_sections import value_text
from tumble.messages import Message

_GROUPS: Final = (
    (Message("bias (µV from its mean)"), NAMES[:3], 1e6),
    (Message("scale factor (ppm from its mean)"), NAMES[3:6], 1e6),
    (Message("misalignment (″ from its mean)"), NAMES[6:12], 1.0),
    (Message("level (″ from its mean)"), NAMES[12:], 1.0),
)
"""Of each panel what it shows, of which parameters, and how many of its unit one of the parameter's is."""


def temperature_section(rows: TriadObservations) -> Section:
    """Parameters at each temperature; empty where there is one temperature, or where one of them cannot be fitted."""
    title = Message("Parameters at each temperature")
    try:
        fitted = at_each_temperature(rows)
    except ValueError:
        return Section(title=title)
    if not fitted:
        return Section(title=title)
    return Section(
        title=title,
        figure=lambda: temperature_figure(fitted),
        caption=Message("Each temperature fitted by itself with the declared model, with 95% intervals."),
        headings=("", *(f"{each.temperature_degc:.1f} °C" for each in fitted)),
        rows=[(name, *(value_text(each.parameters[name]) for each in fitted)) for name in NAMES],
    )


def temperature_figure(fitted: Sequence[AtTemperature]) -> Figure:
    """A panel for biases, scale factors, misalignments and levels, each parameter less its mean."""
    panels = tuple(
        Panel(
            layers=tuple(_layers(fitted, names, factor)),
            x=Axis(label=Message("temperature (°C)")),
            y=Axis(label=label),
        )
        for label, names, factor in _GROUPS
    )
    return Figure(
        name="over-temperature",
        description=Message("Parameters at each temperature"),
        panels=panels,
        columns=2,
        height=200.0,
    )


def _layers(fitted: Sequence[AtTemperature], names: Sequence[str], factor: float) -> Iterator[Layer]:
    """The parameters that every temperature tells, joined in the order in which they were taken."""
    for number, name in enumerate(names):
        found = [_with_interval(each.parameters, name) for each in fitted]
        told = [each for each in found if each is not None]
        if len(told) < len(found):
            continue
        value, low, high = np.array(told).T
        unit = abs(value.mean()) if name.startswith("scale") else 1.0
        shifted = [(each - value.mean()) * factor / unit for each in (value, low, high)]
        temperature_degc = np.array([each.temperature_degc for each in fitted])
        colour = COLOURS[number % len(COLOURS)]
        yield Line(x=temperature_degc, y=shifted[0], colour=colour, width=0.6)
        yield Marks(
            x=temperature_degc,
            y=shifted[0],
            y_ends=(shifted[1], shifted[2]),
            colour=colour,
            shape=SHAPES[number % len(SHAPES)],
            label=name,
        )


def _with_interval(parameters: Mapping[str, Parameter], name: str) -> tuple[float, float, float] | None:
    parameter = parameters[name]
    if parameter.value is None or parameter.interval_95 is None:
        return None
    return (parameter.value, *parameter.interval_95)
