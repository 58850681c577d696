"""The method `gyrocompass`: heading and drift of a gyro platform on an azimuth turntable."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.method import Result
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.gyrocompass.entry import VERSION
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations, read_gyrocompass_table
from tumble.messages import Message

NEEDED = ("azimuth_deg", "rate_deg_h")
"""Columns by which a table is one of gyrocompassing."""
_ASKED = (*NEEDED, "latitude_deg")


@dataclass(frozen=True)
class GyrocompassMethod:
    """A gyro platform that levels itself, in several azimuths."""

    name: str = "gyrocompass"
    version: int = VERSION
    title: str = Message("Gyrocompassing on an azimuth turntable")
    columns: str = Message("a gyrocompass in several azimuths (azimuth_deg, latitude_deg, rate_deg_h)")
    headline: str = "alpha0"

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

    def close_loop(self, paths: Sequence[Path]) -> Result:
        """Trace tables of one platform, taken together. Raises `TableError`, `ValueError`."""
        raise ValueError(
            Message("{path}: heading and drift are not worked out yet", path=read_gyrocompass_table(paths[0]).source)
        )


METHOD = GyrocompassMethod()
