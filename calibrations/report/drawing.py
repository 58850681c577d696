"""Paper and pens: how a figure becomes SVG inside a page, and the colours that every reader can tell apart."""

import io
import re
from html import escape
from typing import Any, Final

import matplotlib as mpl
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.report.figure_texts import put_into_words
from tumble.calibrations.report.language import language, say
from tumble.messages import Language

COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Okabe and Ito 2008, strongest first; one for each mount."""
MARKERS: Final = ("o", "s", "^", "D", "v", "P")
"""Shapes beside the colours, so that no reader needs either alone."""
INK: Final = "#222222"
PALE: Final = "#8a8f98"
CURVE: Final = "#000000"
BAND: Final = "#56B4E9"

MICRO: Final = 1e6
"""Microvolts in a volt."""
WIDE_IN: Final = 9.2
HALF_IN: Final = 4.5
"""Widths of a figure that fills the page and of one that shares it, in inches."""
DENSE_ROWS: Final = 600
"""From here a cloud of marks goes into the page as a picture: as vectors it would weigh 90 bytes a mark."""

_SVG_DPI: Final = 72
"""Texts are as large as that in an SVG file, whatever else is asked for."""

_STYLE: Final[dict[Any, Any]] = {
    "svg.fonttype": "path",  # the same on every machine and printer, without its fonts
    "svg.hashsalt": "tumble",
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "text.parse_math": False,  # a name with two dollar signs is no formula
    "axes.edgecolor": "#666666",
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 9,
    "axes.titlelocation": "left",
    "axes.unicode_minus": True,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e6ea",
    "grid.linewidth": 0.6,
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "legend.frameon": False,
    "legend.fontsize": 8,
    "text.color": INK,
    "savefig.dpi": 160,
}


styled: Final = mpl.rc_context(_STYLE)
"""Decorator of a function that draws: texts and lines take their style when they are made."""


def sheet(width_in: float, height_in: float, rows: int = 1, columns: int = 1) -> tuple[Figure, list[Axes]]:
    """A figure of this size and its axes, row by row, sharing their scales."""
    figure = Figure(figsize=(width_in, height_in), layout="constrained")
    axes = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    return figure, list(axes.flat)


def to_svg(figure: Figure, name: str, description: str) -> Markup:
    """The figure as an SVG element for a page that has others, the same bytes for the same figure.

    Its ids begin with `name`; `description` is what a screen reader says. Messages in it are put into the language of
    the page, numbers along its axes too.
    """
    if language() is not Language.ENGLISH:
        put_into_words(figure)
    _lay_out(figure)
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{name}-", text)
    return Markup(text.replace("<svg ", f'<svg role="img" aria-label="{escape(say(description))}" ', 1))


def _lay_out(figure: Figure) -> None:
    """Place the axes once and for all: left to `savefig`, it would draw the figure twice, first without output."""
    engine = figure.get_layout_engine()
    if engine is not None:
        FigureCanvasSVG(figure)  # texts are as wide as in the file
        figure.set_dpi(_SVG_DPI)
        engine.execute(figure)
        figure.set_layout_engine("none")


def cloud(panel: Axes, x: FloatArray, y: FloatArray, colour: int, *, strong: bool) -> None:
    """Mark every row: `strong` where the rows are the message, pale where they are the background of their means."""
    panel.plot(
        x,
        y,
        linestyle="",
        marker=MARKERS[colour % len(MARKERS)] if strong else ".",
        markersize=3.0 if strong else 3.4,
        markeredgewidth=0,
        color=COLOURS[colour % len(COLOURS)] if strong else PALE,
        alpha=0.8 if strong else 0.6,
        rasterized=len(x) > DENSE_ROWS,
    )
