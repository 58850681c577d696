"""The colours of the window: light, dark, and in high contrast.

Data colours have the hues of Okabe and Ito 2008, as in the reports, darker on light and lighter on dark; a shape or a
word always goes with a colour. Every text, mark and line that says something stands out from its ground by 4.5 : 1 or
more (WCAG 2.1, 1.4.3), in high contrast text by 7 : 1 (1.4.6).
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

MARKERS: Final = ("o", "s", "t1", "d", "t", "p")
"""Shapes of pyqtgraph beside the colours."""


class Shade(StrEnum):
    """Light, dark, in high contrast, or as the desktop is."""

    DESKTOP = "desktop"
    LIGHT = "light"
    DARK = "dark"
    CONTRAST = "contrast"


@dataclass(frozen=True, kw_only=True)
class Colours:
    """What is painted by hand, and what the parts of Qt are painted in."""

    window: str
    paper: str
    other_row: str
    """Every second row of a table."""
    button: str
    outline: str
    """Round buttons."""
    ink: str
    pale: str
    """What is less important, yet readable."""
    disabled: str
    grid: str
    accent: str
    """Done, measured, chosen."""
    highlight: str
    highlighted: str
    """Text on that."""
    now: str
    """Where the run is."""
    bad: str
    good: str
    data: tuple[str, ...]


LIGHT: Final = Colours(
    window="#F2F4F7",
    paper="#FFFFFF",
    other_row="#F6F8FA",
    button="#E6EAEF",
    outline="#A9B2BD",
    ink="#1B222C",
    pale="#5B6573",
    disabled="#606975",
    grid="#D9DEE5",
    accent="#00639C",
    highlight="#00639C",
    highlighted="#FFFFFF",
    now="#BA4B00",
    bad="#A61B1B",
    good="#00664A",
    data=("#00639C", "#B34A00", "#00694D", "#A3487A", "#856000", "#2572A3"),
)
DARK: Final = Colours(
    window="#14171C",
    paper="#1B1F26",
    other_row="#222730",
    button="#2A303A",
    outline="#5A6472",
    ink="#E8ECF2",
    pale="#A3ADBA",
    disabled="#B4BAC3",
    grid="#3A424E",
    accent="#56B4E9",
    highlight="#1F6FA8",
    highlighted="#FFFFFF",
    now="#F0A030",
    bad="#FF8A80",
    good="#4FD1A5",
    data=("#56B4E9", "#F07A2A", "#2FC79A", "#E39BC4", "#F2B632", "#8CCBF2"),
)
CONTRAST: Final = Colours(
    window="#000000",
    paper="#000000",
    other_row="#161616",
    button="#000000",
    outline="#FFFFFF",
    ink="#FFFFFF",
    pale="#E0E0E0",
    disabled="#A8A8A8",
    grid="#8A8A8A",
    accent="#FFE14D",
    highlight="#FFE14D",
    highlighted="#000000",
    now="#FFB84D",
    bad="#FF9E96",
    good="#6BE8BC",
    data=("#6CC5FF", "#FF9A4D", "#5CE6B8", "#F5B5D8", "#FFD24D", "#B5E0FF"),
)
