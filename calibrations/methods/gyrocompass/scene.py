"""What an effect may depend on: everything that is known of each dwell once the declared model is fitted.

Rows of a scene are those of the table: the rate of the first dwell, its tilt, then those of the next; without the tilts
where the table has none that count. So what is measured later follows at the end.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions, heading_slopes
from tumble.calibrations.methods.gyrocompass.lean import Lean
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, DRIFT
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations

_PAUSE = 2.5
"""Dwells that begin further apart than so many times the usual did not follow directly on one another."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassScene:
    """Dwells as an effect sees them; what the table does not say is None."""

    observations: GyrocompassObservations
    theta: FloatArray
    """Declared parameters, as in `model`."""
    lean: Lean
    with_tilts: bool
    """Whether tilts are rows of their own."""
    reference_temperature_degc: float = 23.0

    @property
    def dwells(self) -> int:
        """How many there are."""
        return len(self.observations)

    @property
    def outputs(self) -> int:
        """Rows of a dwell."""
        return 2 if self.with_tilts else 1

    @property
    def rows(self) -> int:
        """How many rows the table has."""
        return self.outputs * self.dwells

    def in_rows(self, rates: FloatArray, tilts: FloatArray | None = None) -> FloatArray:
        """What is added to the rates, shape (dwells, ...), and to the sines of the tilts, in the rows of the table."""
        if not self.with_tilts:
            return np.asarray(rates, dtype=float)
        both = np.stack([rates, np.zeros_like(rates) if tilts is None else tilts], axis=1)
        return np.asarray(both.reshape(self.rows, *rates.shape[1:]), dtype=float)

    @cached_property
    def delta_rad(self) -> FloatArray:
        """Pickoff angle as reported, shape (dwells,)."""
        return np.deg2rad(self.observations.azimuth_deg)

    @cached_property
    def _heading(self) -> FloatArray:
        return np.array([np.sin(self.theta[ALPHA0]), np.cos(self.theta[ALPHA0])])

    @cached_property
    def earth_deg_h(self) -> FloatArray:
        """Earth rate in the levelling channel by the fit, shape (dwells,)."""
        return heading_functions(self.delta_rad, self.observations.latitude_deg, self.lean) @ self._heading

    @cached_property
    def rate_deg_h(self) -> FloatArray:
        """The same with the drift: the rate that the torquer had to make, shape (dwells,)."""
        return np.asarray(self.earth_deg_h + self.theta[DRIFT])

    @property
    def rate_slope(self) -> FloatArray:
        """Change of the rate with the pickoff angle, in °/h per radian, shape (dwells,)."""
        return heading_slopes(self.delta_rad, self.observations.latitude_deg, self.lean) @ self._heading

    @cached_property
    def sin_tilt(self) -> FloatArray:
        """Sine of the tilt γ by the lean, shape (dwells,)."""
        return self.lean.sin_tilt(self.delta_rad)

    def turned(self, angle_rad: FloatArray) -> FloatArray:
        """What errors of the pickoff angle, shape (dwells, ...), do to all rows.

        Rates and tilts both follow the true angle.
        """
        rate, tilt = self.rate_slope, self.lean.sin_tilt(self.delta_rad + np.pi / 2)
        if angle_rad.ndim > 1:
            rate, tilt = rate[:, None], tilt[:, None]
        return self.in_rows(rate * angle_rad, tilt * angle_rad)

    @cached_property
    def hours(self) -> FloatArray | None:
        """Time since the first dwell, in hours, shape (rows,)."""
        return None if self.dwell_hours is None else np.repeat(self.dwell_hours, self.outputs)

    @cached_property
    def dwell_hours(self) -> FloatArray | None:
        """The same, shape (dwells,)."""
        time_s = self.observations.time_s
        return None if time_s is None else (time_s - time_s[0]) / 3600.0

    @cached_property
    def temperature_k(self) -> FloatArray | None:
        """Temperature above the reference, shape (dwells,); missing values are the mean."""
        measured = self.observations.temperature_degc
        if measured is None or not np.isfinite(measured).any():
            return None
        return np.where(np.isfinite(measured), measured, np.nanmean(measured)) - self.reference_temperature_degc

    @cached_property
    def realisation(self) -> NDArray[np.int64]:
        """Number of the realisation of each dwell, from 0."""
        return labels(self.observations.realisations)

    @cached_property
    def direction(self) -> NDArray[np.int64]:
        """Sign of the last move of the turntable; from the angles where the table does not say."""
        if self.observations.direction is not None:
            return self.observations.direction
        step = np.sign(np.diff(self.observations.azimuth_deg, prepend=self.observations.azimuth_deg[:1]))
        last = np.maximum.accumulate(np.where(step != 0, np.arange(len(step)), 0))
        return np.asarray(step[last], dtype=np.int64)

    @cached_property
    def left_over_deg_h(self) -> FloatArray:
        """Rate of the dwell before minus that of this one where it followed directly, else 0, shape (dwells,)."""
        before = np.roll(self.rate_deg_h, 1) - self.rate_deg_h
        return np.where(self._follows, before, 0.0)

    @cached_property
    def _follows(self) -> NDArray[np.bool_]:
        rows = self.observations
        follows = np.diff(rows.row, prepend=rows.row[0] - 2) == 1
        follows &= np.diff(rows.bases, prepend=rows.bases[0]) == 0
        if rows.time_s is not None and len(rows) > 1:
            step_s = np.diff(rows.time_s)
            follows &= np.concatenate([[False], step_s < _PAUSE * float(np.median(step_s))])
        return np.asarray(follows)
