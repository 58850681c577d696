"""What is worked out of a closed loop for those who read it: coefficients by band, and lines of DC against g²."""

from dataclasses import dataclass
from typing import Any

from tumble.calibrations.methods.vibration.bands import BandCoefficient, band_coefficients
from tumble.calibrations.methods.vibration.line import Line, lines
from tumble.calibrations.methods.vibration.loop import VibrationLoop


@dataclass(frozen=True, kw_only=True)
class Shown:
    """Beside what was found."""

    bands: tuple[BandCoefficient, ...]
    lines: tuple[Line, ...]

    def as_json(self) -> dict[str, Any]:
        """Keys that a result has beside those of every method."""
        return {
            "vrc": [each.as_json() for each in self.bands],
            "dc_against_g2": [each.as_json() for each in self.lines],
        }


def shown(loop: VibrationLoop) -> Shown:
    """Work it out."""
    table, trace = loop.explained.table, loop.explained.trace
    return Shown(bands=band_coefficients(table, loop.best, trace), lines=lines(table, loop.best, trace))
