"""The method `vibration`: rectification of an accelerometer under vibration."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.method import Result
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.messages import Message

VERSION = 1
NEEDED = ("output_ug", "ai_g")
"""Columns by which a table of dwells is known; mii_g2 may stand in place of ai_g."""


@dataclass(frozen=True)
class VibrationMethod:
    """Dwells of one accelerometer at rest and under vibration."""

    name: str = "vibration"
    version: int = VERSION
    title: str = Message("Vibration rectification of an accelerometer")
    columns: str = Message("dwells at rest and under vibration (output_ug, ai_g or mii_g2)")
    headline: str = "k_ii"

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:  # noqa: ARG002  # by names alone
        """Whether a table holds outputs of dwells and how they were vibrated."""
        return "output_ug" in header and not {"ai_g", "mii_g2"}.isdisjoint(header)

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # by names alone
        """What is misspelt or missing in a table that looks like one of dwells under vibration."""
        return misspelt(header, [*VibrationObservations.spelt()], NEEDED)

    def close_loop(self, paths: Sequence[Path]) -> Result:
        """Trace tables of one unit, taken together. Raises `TableError`, `ValueError`."""
        raise NotImplementedError


METHOD = VibrationMethod()
