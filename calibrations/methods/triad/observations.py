"""The table of a triad on a two-axis stand, as it is read."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.core.rows import Kind, Rows, column
from tumble.calibrations.core.screening import beyond, with_likely_temperatures, without_missing
from tumble.calibrations.core.table import read_rows

CHANNELS: Final = ("x", "y", "z")
_MOST_DEG: Final = 1e6
"""Beyond any axis: 2,777 turns."""


@dataclass(frozen=True, kw_only=True)
class TriadObservations(Rows):
    """One row a dwell: where both axes stood, and the outputs of three channels; None where the table does not say."""

    settings: ClassVar = ("outer_deg", "inner_deg", "u_x_V", "u_y_V", "u_z_V")

    position_id: NDArray[np.str_] | None = column("position_id", kind=Kind.TEXT, unknown="")
    outer_deg: FloatArray = column("outer_deg", needed=True, required=True)
    """Angle of the outer axis as reported, in degrees."""
    inner_deg: FloatArray = column("inner_deg", needed=True, required=True)
    """Angle of the inner axis as reported, in degrees."""
    u_x_v: FloatArray = column("u_x_V", needed=True, required=True)
    """Mean output of channel x over the dwell, in volts."""
    u_y_v: FloatArray = column("u_y_V", needed=True, required=True)
    u_z_v: FloatArray = column("u_z_V", needed=True, required=True)
    outer_direction: NDArray[np.int64] | None = column(
        "outer_direction", kind=Kind.WHOLE, unknown=0, choices=(1, -1, 0)
    )
    """Sign of the last move of the outer axis; 0 where unknown."""
    inner_direction: NDArray[np.int64] | None = column(
        "inner_direction", kind=Kind.WHOLE, unknown=0, choices=(1, -1, 0)
    )
    temperature_degc: FloatArray | None = column("temperature_degC", unknown=np.nan)
    temperature_x_degc: FloatArray | None = column("temperature_x_degC", unknown=np.nan)
    temperature_y_degc: FloatArray | None = column("temperature_y_degC", unknown=np.nan)
    temperature_z_degc: FloatArray | None = column("temperature_z_degC", unknown=np.nan)
    sd_x_v: FloatArray | None = column("sd_x_V", unknown=np.nan)
    """Standard deviation of the single samples of channel x within the dwell, in volts."""
    sd_y_v: FloatArray | None = column("sd_y_V", unknown=np.nan)
    sd_z_v: FloatArray | None = column("sd_z_V", unknown=np.nan)
    samples: NDArray[np.int64] | None = column("samples", kind=Kind.WHOLE)

    @property
    def outputs_v(self) -> FloatArray:
        """Outputs of the three channels, shape (rows, 3), in volts."""
        return np.column_stack([self.u_x_v, self.u_y_v, self.u_z_v])

    @property
    def positions(self) -> NDArray[np.int64]:
        """Number of the position of each row, from 0: both angles modulo a turn, to a hundredth of a degree."""
        return labels(*(np.round(angle % 360.0, 2) % 360.0 for angle in (self.outer_deg, self.inner_deg)))

    def sample_deviations_v(self) -> list[FloatArray | None]:
        """Standard deviation of the samples of each channel, one array for each; None where the table has none."""
        return [self.sd_x_v, self.sd_y_v, self.sd_z_v]

    def temperatures_degc(self) -> list[FloatArray | None]:
        """Temperature of each channel; that of the case where a channel has none of its own."""
        own = (self.temperature_x_degc, self.temperature_y_degc, self.temperature_z_degc)
        return [self.temperature_degc if each is None else each for each in own]


def read_triad_table(path: Path) -> TriadObservations:
    """Read the table of a triad.

    Rows without finite angles, outputs or time, an overload, and an angle beyond any axis are set aside.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file: one sentence with file, line, column and remedy.
    """
    rows = without_missing(read_rows(path, TriadObservations), ("u_x_v", "u_y_v", "u_z_v"))
    for name in ("outer_deg", "inner_deg"):
        rows = rows.without(beyond(rows, name, np.abs(getattr(rows, name)) > _MOST_DEG, "any axis"))
    for name in ("temperature_degc", "temperature_x_degc", "temperature_y_degc", "temperature_z_degc"):
        rows = with_likely_temperatures(rows, name)
    return rows
