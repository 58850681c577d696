"""The table of a gyrocompass on an azimuth turntable, as it is read."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.core.rows import Kind, Rows, SetAside, column
from tumble.calibrations.core.screening import beyond, with_likely_temperatures, without_missing
from tumble.calibrations.core.table import read_rows
from tumble.calibrations.methods.gyrocompass.declaration import with_checked_noise
from tumble.messages import Message

_MOST_DEG: Final = 1e6
"""Beyond any turntable: 2,777 turns."""
_POLE_DEG: Final = 90.0
_MOST_LATITUDE_DEG: Final = 89.0
"""So near a pole next to nothing of the earth rate is level, and there is no heading."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassObservations(Rows):
    """One row a dwell: where the turntable stood, and the levelling-correction rate of the platform on it."""

    settings: ClassVar = ("azimuth_deg", "latitude_deg", "rate_deg_h")

    base: NDArray[np.int64] | None = column("base", kind=Kind.WHOLE, default=1)
    """Number of the lean of the base: rows that share it stand on the same base, which leans in one way."""
    azimuth_deg: FloatArray = column("azimuth_deg", needed=True, required=True)
    """Pickoff angle δ of the turntable in degrees, counterclockwise seen from above."""
    direction: NDArray[np.int64] | None = column("direction", kind=Kind.WHOLE, unknown=0, choices=(1, -1, 0))
    """Sign of the last move of the turntable; 0 where unknown."""
    tilt_gamma_deg: FloatArray | None = column("tilt_gamma_deg", needed=True)
    """Tilt γ of the platform about its north axis as measured, in degrees; the other tilt is held at 0."""
    latitude_deg: FloatArray = column("latitude_deg", needed=True, required=True)
    """Latitude φ as stated, in degrees, north positive."""
    dwell_s: FloatArray | None = column("dwell_s", unknown=np.nan)
    """Averaging time of the dwell, in seconds."""
    temperature_degc: FloatArray | None = column("temperature_degC", unknown=np.nan)
    rate_deg_h: FloatArray = column("rate_deg_h", needed=True, required=True)
    """Mean levelling-correction rate S, ωζ sin γ taken off, in degrees per hour."""
    rate_sd_deg_h: FloatArray | None = column("rate_sd_deg_h", unknown=np.nan)
    """Standard deviation of the single samples of it within the dwell."""
    samples: NDArray[np.int64] | None = column("samples", kind=Kind.WHOLE)
    azimuth_rate_deg_h: FloatArray | None = column("azimuth_rate_deg_h", unknown=np.nan)
    """Mean rate S2 of the azimuth channel, in degrees per hour."""
    reference_alpha_deg: FloatArray | None = column("reference_alpha_deg", unknown=np.nan)
    """Angle α of the platform's axis from north by an azimuth mark, in degrees, counterclockwise."""
    angle_random_walk_deg_sqrt_h: FloatArray | None = column("angle_random_walk_deg_sqrt_h", unknown=np.nan)
    """N of the gyro as declared; this and the next ones are the same in every row that tells them."""
    bias_instability_deg_h: FloatArray | None = column("bias_instability_deg_h", unknown=np.nan)
    """B of the gyro as declared."""
    rate_random_walk_deg_h_sqrt_h: FloatArray | None = column("rate_random_walk_deg_h_sqrt_h", unknown=np.nan)
    """K of the gyro as declared."""
    gauss_markov_deg_h: FloatArray | None = column("gauss_markov_deg_h", unknown=np.nan)
    """Standard deviation of a Gauss-Markov process as declared."""
    correlation_s: FloatArray | None = column("correlation_s", unknown=np.nan)
    """Its correlation time as declared."""

    @property
    def base_numbers(self) -> NDArray[np.int64]:
        """Base of each row as the table calls it; 1 where it does not say."""
        return np.ones(len(self), dtype=np.int64) if self.base is None else self.base

    @property
    def bases(self) -> NDArray[np.int64]:
        """Number of the base of each row, from 0."""
        return labels(self.base_numbers)

    @property
    def positions(self) -> NDArray[np.int64]:
        """Number of the position of each row, from 0: base and angle modulo a turn, to a hundredth of a degree."""
        return labels(self.bases, np.round(self.azimuth_deg % 360.0, 2) % 360.0)


def read_gyrocompass_table(path: Path) -> GyrocompassObservations:
    """Read the table of a gyrocompass.

    Rows without finite angle, rate, tilt, latitude or time, an overload, an angle beyond any turntable and a latitude
    at a pole are set aside.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file, or a declared noise that is none: one sentence with file, line, column
        and remedy.
    """
    rows = without_missing(read_rows(path, GyrocompassObservations), ("rate_deg_h",))
    rows = rows.without(beyond(rows, "azimuth_deg", np.abs(rows.azimuth_deg) > _MOST_DEG, "any turntable"))
    rows = rows.without(_at_a_pole(rows))
    return with_likely_temperatures(with_checked_noise(rows, path))


def _at_a_pole(rows: GyrocompassObservations) -> tuple[SetAside, ...]:
    """Rows at latitudes where there is no heading."""
    near = np.abs(rows.latitude_deg) > _MOST_LATITUDE_DEG
    return tuple(
        SetAside(row=row, reason=_no_heading(value))
        for row, value in zip(rows.row[near].tolist(), rows.latitude_deg[near].tolist(), strict=True)
    )


def _no_heading(latitude_deg: float) -> Message:
    if abs(latitude_deg) > _POLE_DEG:
        return Message("latitude_deg is {value:g}, and no latitude is beyond 90", value=latitude_deg)
    return Message(
        "latitude_deg is {value:g}: so near a pole next to nothing of the earth rate is level, and there is no heading",
        value=latitude_deg,
    )
