"""Where a calibration comes from: what record and report say beside the numbers."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class Source:
    """A raw file from which a result comes."""

    kind: str
    """`recording` or `table`."""
    path: str
    """Relative to the folder of the store, with `/`, where the file lies inside; absolute elsewhere."""
    sha256: str


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """The chain from the raw file to the numbers. Texts are empty where the source does not say."""

    serial_number: str
    """Of the unit under test."""
    lot: str = ""
    """In which the unit was made."""
    operator: str = ""
    programme_name: str = ""
    programme_sha256: str = ""
    stand_name: str = ""
    stand: Mapping[str, Any]
    """The stand file as data, without what is simulated; empty for a bare table."""
    sources: tuple[Source, ...]
    """The raw files, in the order in which they were joined."""
    measured_at: str = ""
    """Start of the run, ISO 8601 with time zone."""
    program_version: str
    git_commit: str = ""
    git_dirty: bool = False
    packages: Mapping[str, str]
    """Version of every package that took part in the analysis, by name."""

    @property
    def source_hashes(self) -> tuple[str, ...]:
        """SHA-256 of every raw file."""
        return tuple(source.sha256 for source in self.sources)

    @property
    def is_simulated(self) -> bool:
        """Whether the stand was simulated: a real instrument sees no simulated one, so that none is mixed."""
        return _is_simulated(self.stand)


@dataclass(frozen=True, kw_only=True)
class LimitCheck:
    """One parameter against the limits of the programme."""

    name: str
    minimum: float | None
    maximum: float | None
    inside: bool
    """False also where the parameter has no value."""


def inside(value: float, limits: LimitCheck) -> bool:
    """Whether a value lies inside its limits; a limit itself does."""
    above = limits.minimum is None or value >= limits.minimum
    return above and (limits.maximum is None or value <= limits.maximum)


def _is_simulated(table: Mapping[str, Any]) -> bool:
    """Whether a table of a stand file, or one within it, is of a simulated instrument."""
    within = (each for each in table.values() if isinstance(each, Mapping))
    return table.get("driver") == "simulated" or any(map(_is_simulated, within))
