"""The table that the analysis reads: one row per dwell, in the order in which they were taken."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.geometry import FloatArray

OVERLOAD_V = 1e30
"""A voltage beyond this is an instrument's way to say overload (SCPI-1999, volume 1, 7.2.1.5: 9.9E37 is infinity)."""


@dataclass(frozen=True, kw_only=True)
class SetAside:
    """A row that is not used, and why."""

    row: int
    """Number of the data row, the first being 1."""
    reason: str
    gross: bool = False
    """Whether its output is a gross error, not a value that is missing or none."""


@dataclass(frozen=True, kw_only=True)
class Observations:
    """Dwells as arrays of equal length; None where the table does not say.

    Rows that hold NaN, infinity or an overload are already out and listed in `set_aside`.
    """

    row: NDArray[np.int64]
    """Number of the data row in the source, the first being 1."""
    angle_deg: FloatArray
    """Head angle as reported, in degrees; any revolution."""
    voltage_v: FloatArray | None = None
    """Mean output over the dwell, in volts."""
    reference_deg: FloatArray | None = None
    """What a reference says of the angle, in degrees; may wrap."""
    velocity_deg_s: FloatArray | None = None
    time_s: FloatArray | None = None
    """Middle of the dwell, in seconds from any origin."""
    realisation: NDArray[np.int64] | None = None
    procedure: NDArray[np.str_] | None = None
    mount: NDArray[np.str_] | None = None
    direction: NDArray[np.int64] | None = None
    """Sign of the last move of the head; 0 where unknown."""
    temperature_degc: FloatArray | None = None
    voltage_sd_v: FloatArray | None = None
    """Standard deviation of the single samples within the dwell, in volts."""
    samples: NDArray[np.int64] | None = None
    run: NDArray[np.int64] | None = None
    """Number of the run of each row, from 0, where several were joined: the unit was seated anew for each."""
    correction_deg: FloatArray | None = None
    """What a stand record adds to the reported angle, in degrees."""
    extra: Mapping[str, FloatArray | NDArray[np.str_]] = field(default_factory=dict)
    """Columns that the contract does not know, kept as covariates."""
    set_aside: tuple[SetAside, ...] = ()
    warnings: tuple[str, ...] = ()
    """Sentences for the reader of the result: a cut file, a last line without an end."""
    complete: bool = True
    """False where the source was cut off."""
    source: str = ""
    """What to call the source in a message."""

    def __len__(self) -> int:
        """Return the number of usable rows."""
        return len(self.angle_deg)

    @property
    def rows_read(self) -> int:
        """Rows in the source, usable or not."""
        return len(self) + len(self.set_aside)

    @property
    def output_v(self) -> FloatArray:
        """Output of every row, in volts. Raises `ValueError` where the table holds none."""
        if self.voltage_v is None:
            raise ValueError(f"{self.source}: there is no column voltage_V; a calibration needs the unit's output")
        return self.voltage_v

    @property
    def true_angle_deg(self) -> FloatArray:
        """Head angle as far as it is known: as reported, and corrected where a stand record says by how much."""
        return self.angle_deg if self.correction_deg is None else self.angle_deg + self.correction_deg

    @property
    def mounts(self) -> NDArray[np.str_]:
        """Mount of every row; face-up where the table does not say."""
        return np.full(len(self), "face-up") if self.mount is None else self.mount

    @property
    def realisations(self) -> NDArray[np.int64]:
        """Realisation of every row; 1 where the table does not say."""
        return np.ones(len(self), dtype=np.int64) if self.realisation is None else self.realisation

    @property
    def runs(self) -> NDArray[np.int64]:
        """Run of every row; 0 where there is only one."""
        return np.zeros(len(self), dtype=np.int64) if self.run is None else self.run

    def select(self, keep: NDArray[np.bool_]) -> "Observations":
        """Return the rows for which `keep` is true; what is set aside stays listed."""
        columns: dict[str, Any] = {
            name: None if (column := getattr(self, name)) is None else column[keep] for name in ARRAY_COLUMNS
        }
        extra = {name: column[keep] for name, column in self.extra.items()}
        return replace(self, **columns, extra=extra)

    def without(self, rejected: tuple[SetAside, ...]) -> "Observations":
        """Return the table without the rows in `rejected`, which join `set_aside`."""
        keep = ~np.isin(self.row, [entry.row for entry in rejected])
        aside = tuple(sorted((*self.set_aside, *rejected), key=lambda entry: entry.row))
        return replace(self.select(keep), set_aside=aside)


ARRAY_COLUMNS = (
    "row",
    "angle_deg",
    "voltage_v",
    "reference_deg",
    "velocity_deg_s",
    "time_s",
    "realisation",
    "procedure",
    "mount",
    "direction",
    "temperature_degc",
    "voltage_sd_v",
    "samples",
    "run",
    "correction_deg",
)
"""The fields of `Observations` that hold one value per row."""
