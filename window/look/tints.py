"""Grounds of what is read from two metres, each with an ink that stands out from it, light and dark alike."""

from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, kw_only=True)
class Tint:
    """A ground and the ink on it; contrast at least 4.5 : 1 (WCAG 2.1, 1.4.3)."""

    ground: str
    ink: str = "#FFFFFF"


GREY: Final = Tint(ground="#4A5360")
BLUE: Final = Tint(ground="#00639C")
AMBER: Final = Tint(ground="#FFB300", ink="#000000")
VIOLET: Final = Tint(ground="#6A3D9A")
RED: Final = Tint(ground="#B71C1C")
GREEN: Final = Tint(ground="#00664A")
