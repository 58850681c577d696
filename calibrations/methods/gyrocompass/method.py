"""The method `gyrocompass`: heading and drift of a gyro platform on an azimuth turntable."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tumble.calibrations.core.joining import joined
from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Quantity, Section
from tumble.calibrations.methods.gyrocompass.at_the_stand import loop_at
from tumble.calibrations.methods.gyrocompass.budget import TurntableUncertainty
from tumble.calibrations.methods.gyrocompass.document import document
from tumble.calibrations.methods.gyrocompass.entry import VERSION, entry
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop, asked_next, close_gyrocompass_loop
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations, read_gyrocompass_table
from tumble.calibrations.methods.gyrocompass.quantities import QUANTITIES
from tumble.calibrations.methods.gyrocompass.sections import sections
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.loop_result import LoopResult
from tumble.messages import Message

NEEDED = ("azimuth_deg", "rate_deg_h")
"""Columns by which a table is one of gyrocompassing."""
_ASKED = (*NEEDED, "latitude_deg")


@dataclass(frozen=True, kw_only=True)
class GyrocompassResult(LoopResult):
    """Tables of one platform, taken together."""

    loop: GyrocompassLoop

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
class GyrocompassMethod:
    """A gyro platform that levels itself, in several azimuths."""

    name: str = "gyrocompass"
    version: int = VERSION
    title: str = Message("Gyrocompassing on an azimuth turntable")
    columns: str = Message("a gyrocompass in several azimuths (azimuth_deg, latitude_deg, rate_deg_h)")
    headline: str = "alpha0"
    quantities: Mapping[str, Quantity] = field(default_factory=lambda: QUANTITIES)

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:  # noqa: ARG002  # by names alone
        """Whether a table holds the angle of the turntable and the rate."""
        return set(NEEDED) <= set(header)

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # by names alone
        """What is misspelt or missing in a table that holds one of them."""
        if asked := misspelt(header, [*GyrocompassObservations.spelt()], NEEDED):
            return asked
        if not any(name in NEEDED for name in header):
            return ""
        return Message(
            "this looks like a table of a gyrocompass, and it lacks {missing}",
            missing=series([name for name in _ASKED if name not in header]),
        )

    def close_loop(self, paths: Sequence[Path]) -> GyrocompassResult:
        """Trace tables of one platform, taken together. Raises `TableError`, `ValueError`."""
        rows = joined([read_gyrocompass_table(path) for path in paths], [None] * len(paths))
        return GyrocompassResult(loop=loop_at(asked_next(close_gyrocompass_loop(rows)), TurntableUncertainty()))


METHOD = GyrocompassMethod()
