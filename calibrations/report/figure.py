"""A figure described: what is drawn against what, in which units; how it looks is the business of who draws it.

A report draws it as vectors (`svg`), a window by its own means. It knows no language until it is drawn.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from markupsafe import Markup

from tumble.calibrations.report.extent import extent
from tumble.calibrations.report.layers import (
    BAND,
    COLOURS,
    INK,
    MICRO,
    PALE,
    SHAPES,
    Area,
    Axis,
    Boxes,
    Cells,
    Layer,
    Line,
    Marks,
    Panel,
    Shades,
    Shape,
    Sheet,
    Span,
)
from tumble.calibrations.report.svg import drawn

__all__ = [
    "BAND",
    "COLOURS",
    "INK",
    "MICRO",
    "PALE",
    "SHAPES",
    "Area",
    "Axis",
    "Boxes",
    "Cells",
    "Figure",
    "Layer",
    "Line",
    "Marks",
    "Panel",
    "Shades",
    "Shape",
    "Span",
    "on_one_scale",
    "residual_line",
]


@dataclass(frozen=True, kw_only=True)
class Figure(Sheet):
    """Panels beside and below each other, which a report draws as SVG."""

    def __html__(self) -> Markup:
        """The figure as SVG, in the language of the page that is written."""
        return drawn(self)


def on_one_scale(panels: Sequence[Panel]) -> tuple[Panel, ...]:
    """Panels whose axes begin and end alike."""
    ends = [extent(panel) for panel in panels]
    x, y = ((min(pair[axis][0] for pair in ends), max(pair[axis][1] for pair in ends)) for axis in (0, 1))
    return tuple(replace(each, x=replace(each.x, ends=x), y=replace(each.y, ends=y)) for each in panels)


def residual_line(scatter: float) -> tuple[Layer, ...]:
    """Zero, and the scatter of a row on both sides of it."""
    return Span(low=-scatter, high=scatter), Span(low=0.0, high=0.0, colour=INK, opacity=1.0)
