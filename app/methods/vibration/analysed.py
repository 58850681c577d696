"""A raw file of vibrated dwells analysed: fitted, and what is left traced."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from tumble.app.loop_analysed import LoopAnalysed, LoopTraced
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.vibration.document import document, fit_document
from tumble.calibrations.methods.vibration.loop import VibrationDeclared, VibrationLoop
from tumble.calibrations.methods.vibration.method import METHOD
from tumble.calibrations.methods.vibration.sections import sections_beside_values


@dataclass(frozen=True, kw_only=True)
class VibrationAnalysed(LoopAnalysed):
    """A raw file and what the declared model says of it."""

    method = METHOD
    output_unit = "µg"

    declared: VibrationDeclared

    def fit_document(self) -> dict[str, Any]:
        """The coefficients as `tumble.fit/1`."""
        return fit_document(self.declared)


@dataclass(frozen=True, kw_only=True)
class VibrationTraced(VibrationAnalysed, LoopTraced):
    """The same with the loop closed."""

    loop: VibrationLoop

    def loop_document(self) -> dict[str, Any]:
        """The closed loop as `tumble.loop/1`."""
        return document(self.loop)

    def sections(self) -> Sequence[Section]:
        """What was found, before and after, and what to measure next."""
        return tuple(sections_beside_values(self.loop))
