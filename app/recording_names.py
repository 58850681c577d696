"""What the file of a recording is called."""

import re
from datetime import UTC, datetime
from hashlib import sha256
from pathlib import Path

from tumble.drivers.clock import Clock

_LONGEST_NAME = 60
_RESERVED = {"CON", "PRN", "AUX", "NUL", *(f"{port}{n}" for port in ("COM", "LPT") for n in range(10))}
"""Names of devices on Windows."""


def recording_path(folder: Path, serial_number: str, programme: str, clock: Clock) -> Path:
    """Where a run of a unit is recorded: `recordings/SERIAL/UTC-programme.mcap`, a name that sorts by time."""
    moment = datetime.fromtimestamp(clock.wall_ns() / 1e9, tz=UTC).strftime("%Y%m%dT%H%M%SZ")
    name = f"{moment}-{as_file_name(programme)}"
    path = folder / "recordings" / as_file_name(serial_number) / f"{name}.mcap"
    number = 1
    while path.exists():
        number += 1
        path = path.with_name(f"{name}-{number}.mcap")
    return path


def as_file_name(text: str) -> str:
    """Text as a file name on any system: what had to be changed gets a hash, so that no two texts share a name."""
    plain = re.sub(r"[^A-Za-z0-9._-]+", "_", text).strip("._")[:_LONGEST_NAME]
    reserved = plain.split(".")[0].upper() in _RESERVED
    if plain == text and not reserved:
        return plain
    if reserved:
        plain = plain.replace(".", "_")  # Windows looks at what stands before the first one
    return f"{plain or 'unit'}-{sha256(text.encode('utf-8', 'surrogatepass')).hexdigest()[:8]}"
