"""What somebody looks for in a store, apart from the database, which takes half a second to import."""

from dataclasses import dataclass
from datetime import datetime

from tumble.calibrations.core.verdict import Outcome


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """Which records are looked for; what is empty matches everything."""

    part_of_serial_number: str = ""
    """In capitals or small letters."""
    part_of_lot: str = ""
    """Likewise."""
    programme_name: str = ""
    stand_name: str = ""
    method: str = ""
    """Name of a method, as in the result formats."""
    verdict: Outcome | None = None
    finding: str | None = None
    """Name of an effect, `findings.UNNAMED`, or empty: nothing was found."""
    since: datetime | None = None
    until: datetime | None = None
    """Both included; they need a time zone."""
