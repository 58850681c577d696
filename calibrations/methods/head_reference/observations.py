"""The table of a head that is measured against a reference, as it is read."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.rows import Kind, Rows, column
from tumble.calibrations.core.screening import beyond, with_likely_temperatures, without_missing
from tumble.calibrations.core.table import read_rows
from tumble.messages import Message

_MOST_DEG = 1e6
"""Beyond any head: 2,777 turns."""


@dataclass(frozen=True, kw_only=True)
class HeadObservations(Rows):
    """Angles of a head and of its reference; None where the table does not say."""

    settings: ClassVar = ("angle_deg",)
    outputs: ClassVar = ("reference_deg",)

    procedure: NDArray[np.str_] | None = column("procedure", kind=Kind.TEXT, unknown="")
    angle_deg: FloatArray = column("angle_deg", needed=True, required=True)
    """Head angle as reported, in degrees; any revolution."""
    direction: NDArray[np.int64] | None = column("direction", kind=Kind.WHOLE, unknown=0, choices=(1, -1, 0))
    """Sign of the last move of the head; 0 where unknown."""
    temperature_degc: FloatArray | None = column("temperature_degC", unknown=np.nan)
    samples: NDArray[np.int64] | None = column("samples", kind=Kind.WHOLE)
    reference_deg: FloatArray | None = column("reference_deg", needed=True)
    """What the reference says of the angle, in degrees; may wrap."""
    velocity_deg_s: FloatArray | None = column("velocity_deg_s", needed=True)


def read_head_table(path: Path) -> HeadObservations:
    """Read a table of a head against a reference.

    Rows without a finite angle, reference, velocity or time, and those whose angle is beyond any head, are set aside.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file: one sentence with file, line, column and remedy.
    """
    rows = without_missing(read_rows(path, HeadObservations))
    garbled = beyond(rows, "angle_deg", np.abs(rows.angle_deg) > _MOST_DEG, Message("any head"))
    return with_likely_temperatures(rows.without(garbled))
