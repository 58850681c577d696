"""What a figure is made of: axes, panels, and the layers that are drawn in them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

from tumble.calibrations.core.arrays import FloatArray

COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Okabe and Ito 2008, strongest first; one for each mount."""
INK: Final = "#222222"
PALE: Final = "#8a8f98"
BAND: Final = "#56B4E9"
MICRO: Final = 1e6
"""Microvolts in a volt."""

Shape: TypeAlias = Literal["circle", "square", "triangle", "diamond", "down", "cross", "dot"]
SHAPES: Final[tuple[Shape, ...]] = ("circle", "square", "triangle", "diamond", "down", "cross")
"""Beside the colours, so that no reader needs either alone."""


@dataclass(frozen=True, kw_only=True)
class Axis:
    """What one side of a panel says."""

    label: str = ""
    """With the unit; empty where a neighbour says it."""
    ends: tuple[float, float] | None = None
    """Where the axis begins and ends; without, where what is drawn does."""
    ticks: Sequence[float] = ()
    """Places of numbers; without, round ones are found."""
    names: Sequence[str] = ()
    """What stands at `ticks` in place of their numbers."""
    logarithmic: bool = False
    whole: bool = False
    """Whether nothing lies between whole numbers."""


@dataclass(frozen=True, kw_only=True)
class Marks:
    """A mark at every point, with the ends of a bar through it where there are any."""

    x: FloatArray
    y: FloatArray
    colour: str = COLOURS[0]
    shape: Shape = "circle"
    size: float = 3.0
    """Across, in points of 1/72 inch."""
    opacity: float = 1.0
    hollow: bool = False
    y_ends: tuple[FloatArray, FloatArray] | None = None
    x_ends: tuple[FloatArray, FloatArray] | None = None
    bar: float = 0.8
    """Width of these bars in points."""
    label: str = ""


@dataclass(frozen=True, kw_only=True)
class Line:
    """Points joined in their order; NaN breaks it."""

    x: FloatArray
    y: FloatArray
    colour: str = COLOURS[0]
    width: float = 1.2
    dashed: bool = False
    label: str = ""


@dataclass(frozen=True, kw_only=True)
class Area:
    """What lies between two curves."""

    x: FloatArray
    low: FloatArray
    high: FloatArray
    colour: str = BAND
    opacity: float = 0.35


@dataclass(frozen=True, kw_only=True)
class Span:
    """A band over the whole width of the panel, or a line where its ends meet."""

    low: float
    high: float
    colour: str = BAND
    opacity: float = 0.2


@dataclass(frozen=True, kw_only=True)
class Boxes:
    """Median, quartiles, and whiskers to the last value within 1.5 times their distance (Tukey), one box a place."""

    groups: Sequence[FloatArray]
    colour: str = COLOURS[0]


@dataclass(frozen=True, kw_only=True)
class Cells:
    """A square for each number of a matrix, from blue for -1 over white to red for 1; row 0 is on top."""

    values: FloatArray
    texts: Sequence[Sequence[str]] = ()
    """What stands in each; nothing without."""


@dataclass(frozen=True, kw_only=True)
class Shades:
    """A mark at every point whose colour says a number, between -`most` and `most`."""

    x: FloatArray
    y: FloatArray
    values: FloatArray
    most: float


Layer: TypeAlias = Marks | Line | Area | Span | Boxes | Cells | Shades


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A pair of axes and what is drawn between them, the lowest first."""

    layers: tuple[Layer, ...]
    x: Axis = Axis()
    y: Axis = Axis()
    title: str = ""
    equal_units: bool = False
    """Whether a unit is as long up as across, at any size; a page has it by the height and width of its figure."""


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """Panels beside and below each other; what `tumble.calibrations.report.figure.Figure` is made of."""

    name: str
    """In lower case with `-`; no two figures of a page share it."""
    description: str
    """What a screen reader says."""
    panels: tuple[Panel, ...]
    columns: int = 1
    height: float = 200.0
    """Of a panel with its labels, in units of which the page is 720 wide."""
    width: float = 720.0
    scale: tuple[str, float] | None = None
    """Label and largest number of a scale of colours for `Cells` and `Shades`."""
