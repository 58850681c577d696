"""What is shown of an adopted effect, on the terminal and as a page."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from tumble.calibrations.adopted.effect import AdoptedEffect
from tumble.calibrations.adopted.figures import course_figure
from tumble.calibrations.adopted.folder import Kept
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Section
from tumble.messages import Message

_LINES: Final = 25
"""Of the course, in a table."""


def sections(kept: Kept) -> tuple[Section, ...]:
    """What the effect is, its course, and the units on which it was found."""
    effect = kept.effect
    return (
        Section(title=effect.name, lines=tuple(_said(kept)), brief=True),
        Section(
            title=Message("Course"),
            figure=lambda: course_figure(effect, _headed(Message("variable"), effect.variable_unit)),
            caption=Message("The course in units of mean size, with its expanded uncertainty (k = 2)."),
            headings=(
                _headed(Message("variable"), effect.variable_unit),
                Message("course"),
            ),
            rows=tuple(_course(effect)),
            brief=True,
        ),
        Section(
            title=Message("Units"),
            headings=(Message("unit"), Message("size"), Message("measured"), Message("files")),
            rows=tuple(_units(effect)),
            brief=True,
        ),
    )


def status(kept: Kept) -> Message:
    """Whether it is sought."""
    return Message("in force") if kept.in_force else Message("retired")


def depends(effect: AdoptedEffect) -> str:
    """On what it acts and what it follows, by the words of the result formats."""
    return f"{effect.channel} × {' '.join([effect.variable, effect.detail]).strip()}"


def size_text(effect: AdoptedEffect) -> str:
    """Its largest value."""
    largest = int(np.argmax(np.abs(effect.curve.values)))
    return format_number(abs(float(effect.curve.values[largest])), effect.channel_unit, 2)


def spread_text(effect: AdoptedEffect) -> str:
    """By how much units differ, of the mean; empty where one was seen."""
    return "" if effect.spread is None else f"{100.0 * effect.spread:.0f}%"


def _said(kept: Kept) -> Iterator[str]:
    effect = kept.effect
    yield Message(
        "{name}: {depends}, up to {size}; kept with {where}; {status}",
        name=effect.name,
        depends=depends(effect),
        size=size_text(effect),
        where=effect.kept_with.words,
        status=status(kept),
    )
    if kept.retired:
        yield Message(
            "retired on {day} by {operator}: {reason}",
            day=f"{kept.retired.retired_at:%Y-%m-%d}",
            operator=kept.retired.operator or Message("somebody"),
            reason=kept.retired.reason,
        )
    if effect.spread is not None:
        yield Message.counted(
            "its size differs from unit to unit by {spread} of the mean (standard deviation, {count} unit)",
            "its size differs from unit to unit by {spread} of the mean (standard deviation, {count} units)",
            spread=spread_text(effect),
            count=len(effect.units),
        )
    if effect.also_possible:
        others = [f"{channel} × {variable}" for channel, variable in effect.also_possible]
        yield Message("these units do not part it from {others}", others=series(others, "or"))
    yield Message(
        "adopted on {day} by {operator} with tumble {version}",
        day=f"{effect.adopted_at:%Y-%m-%d}",
        operator=effect.operator or Message("somebody"),
        version=effect.program_version,
    )


def _course(effect: AdoptedEffect) -> Iterator[tuple[str, str]]:
    knots, curve = effect.curve.knots, effect.curve
    chosen = np.unique(np.linspace(0, len(knots.places) - 1, _LINES).round().astype(int))
    for number in chosen.tolist():
        place = ", ".join(f"{value:.3g}" for value in knots.places[number])
        yield (
            place,
            format_concise(float(curve.values[number]), float(curve.standard_uncertainty[number]), effect.channel_unit),
        )


def _units(effect: AdoptedEffect) -> Iterator[tuple[str, ...]]:
    for unit in effect.units:
        size = format_concise(unit.size, unit.standard_uncertainty, "")
        files = Message.joined(", ", [f"{source.path} ({source.sha256[:12]})" for source in unit.sources])
        yield unit.serial_number, size, unit.measured_at, files


def _headings(effect: AdoptedEffect) -> Iterator[Message]:
    yield _headed(Message("variable"), effect.variable_unit)
    yield _headed(Message("course"), effect.channel_unit)


def _headed(word: Message, unit: str) -> Message:
    return Message("{word} ({unit})", word=word, unit=unit) if unit else word
