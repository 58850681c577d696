"""What a recording says of itself before the first point."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

FORMAT_VERSION = 1


@dataclass(frozen=True, kw_only=True)
class Header:
    """Everything needed to know how a recording came about and to go on with it."""

    serial_number: str
    """Serial number of the unit under test."""
    operator: str
    programme_text: str
    """The programme as it was read, TOML."""
    programme_sha256: str
    stand: Mapping[str, Any]
    """The stand file as data, without its `simulated` table: what is simulated never reaches a recording."""
    stand_path: str
    """Where the stand file lay; empty for the built-in stand."""
    stand_sha256: str
    """Of the whole stand file, `simulated` table included."""
    program_version: str
    git_commit: str
    """Commit of the running program; empty where it runs outside a checkout."""
    git_dirty: bool
    packages: Mapping[str, str]
    """Version of every package that took part, by name."""
    started_wall_ns: int
    """Nanoseconds since 1970-01-01 UTC."""
    started_monotonic_s: float
    """The stand's monotonic clock at the same moment."""
    format_version: int = FORMAT_VERSION
