"""The method `vibration`: rectification of an accelerometer under vibration."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from tumble.calibrations.core.joining import joined
from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Quantity, Section
from tumble.calibrations.methods.vibration.at_the_stand import loop_at
from tumble.calibrations.methods.vibration.budget import VibrationUncertainty
from tumble.calibrations.methods.vibration.document import NAME, document
from tumble.calibrations.methods.vibration.dwells.reduction import reduced
from tumble.calibrations.methods.vibration.dwells.samples import are_samples, read_samples
from tumble.calibrations.methods.vibration.dwells.shown import ReducedSamples
from tumble.calibrations.methods.vibration.entry import VERSION, entry
from tumble.calibrations.methods.vibration.loop import VibrationLoop, asked_next, close_vibration_loop
from tumble.calibrations.methods.vibration.observations import VibrationObservations, read_vibration_table
from tumble.calibrations.methods.vibration.prediction import PredictedShown, predicted
from tumble.calibrations.methods.vibration.profile import read_spectrum, shipped_profiles
from tumble.calibrations.methods.vibration.quantities import QUANTITIES
from tumble.calibrations.methods.vibration.sections import sections
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.loop_result import LoopResult
from tumble.messages import Message

NEEDED: Final = ("output_ug", "ai_g")
_SHOWING: Final = (*NEEDED, "mii_g2", "level_g", "drive_i")
"""Columns that no other table has."""
"""Columns by which a table of dwells is known; mii_g2 may stand in place of ai_g."""


@dataclass(frozen=True, kw_only=True)
class VibrationResult(LoopResult):
    """Tables of one unit, taken together."""

    loop: VibrationLoop

    def document(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`."""
        return document(self.loop)

    def entry(self) -> Entry:
        """The result as the store takes it."""
        return entry(self.loop)

    def shown(self) -> Iterator[Section]:
        """What is shown of the loop, the answer first."""
        return sections(self.loop)


@dataclass(frozen=True)
class VibrationMethod:
    """Dwells of one accelerometer at rest and under vibration."""

    name: str = NAME
    version: int = VERSION
    title: str = Message("Vibration rectification of an accelerometer")
    columns: str = Message("dwells at rest and under vibration (output_ug, and ai_g or mii_g2)")
    headline: str = "k_ii"
    quantities: Mapping[str, Quantity] = field(default_factory=lambda: QUANTITIES)

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:  # noqa: ARG002  # by names alone
        """Whether a table holds outputs of dwells and how they were vibrated."""
        return "output_ug" in header and not {"ai_g", "mii_g2"}.isdisjoint(header)

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # by names alone
        """What to do with samples of dwells, and what is misspelt in a table that looks like one of dwells."""
        if are_samples(header):
            return Message("these are samples of dwells; `tumble reduce` makes a table of dwells of them")
        if asked := misspelt(header, [*VibrationObservations.spelt()], NEEDED):
            return asked
        if not any(name in _SHOWING for name in header):
            return ""
        return Message(
            "this looks like a table of vibrated dwells, and it lacks {missing}",
            missing=series([name for name in NEEDED if name not in header]),
        )

    def are_samples(self, header: Sequence[str]) -> bool:
        """Whether a table holds samples of dwells."""
        return are_samples(header)

    def reduced(self, path: Path) -> ReducedSamples:
        """Reduce samples of dwells. Raises `TableError`."""
        return ReducedSamples(reduction=reduced(read_samples(path)))

    @property
    def profiles(self) -> Sequence[str]:
        """Names of the spectra that come along."""
        return shipped_profiles()

    def predicted(self, paths: Sequence[Path], spectrum: str, axis: str) -> PredictedShown:
        """Predict the rectification of a spectrum from tables of one unit. Raises `TableError`, `ValueError`."""
        profile = read_spectrum(spectrum)
        rows = joined([read_vibration_table(path) for path in paths], [None] * len(paths))
        return PredictedShown(predicted=predicted(close_vibration_loop(rows), profile, axis), warnings=rows.warnings)

    def close_loop(self, paths: Sequence[Path]) -> VibrationResult:
        """Trace tables of one unit, taken together. Raises `TableError`, `ValueError`."""
        rows = joined([read_vibration_table(path) for path in paths], [None] * len(paths))
        return VibrationResult(loop=loop_at(asked_next(close_vibration_loop(rows)), VibrationUncertainty()))


METHOD = VibrationMethod()
