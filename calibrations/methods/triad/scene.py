"""What an effect may depend on: everything that is known of each dwell once the declared model is fitted.

Rows of a scene are those of the table of all channels: x, y, z of the first dwell, then those of the next. So what is
measured later follows at the end.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.triad.geometry import Directions, directions, inner_change
from tumble.calibrations.methods.triad.model import LEVEL_X, LEVEL_Y, response
from tumble.calibrations.methods.triad.observations import TriadObservations

PAUSE_S = 600.0
"""Two dwells further apart than this did not follow directly on one another."""


@dataclass(frozen=True, kw_only=True)
class TriadScene:
    """Dwells as an effect sees them; what the table does not say is None."""

    observations: TriadObservations
    theta: FloatArray
    """Declared parameters, as in `model`."""
    reference_temperature_degc: float = 23.0

    @property
    def dwells(self) -> int:
        """How many there are."""
        return len(self.observations)

    @property
    def rows(self) -> int:
        """How many rows the table has: three for each dwell."""
        return 3 * self.dwells

    @cached_property
    def directions(self) -> Directions:
        """The three vectors of `geometry` for each dwell."""
        return directions(self.observations.outer_deg, self.observations.inner_deg)

    @cached_property
    def gravity_g(self) -> FloatArray:
        """Gravity in the case, shape (dwells, 3)."""
        return self.directions.gravity(float(self.theta[LEVEL_X]), float(self.theta[LEVEL_Y]))

    @cached_property
    def felt_g(self) -> FloatArray:
        """Gravity along each input axis, shape (dwells, 3)."""
        k = response(self.theta)
        return np.asarray(self.gravity_g @ (k / np.linalg.norm(k, axis=1, keepdims=True)).T)

    @cached_property
    def output_v(self) -> FloatArray:
        """Outputs by the fit, shape (dwells, 3)."""
        return np.asarray(self.theta[:3] + self.gravity_g @ response(self.theta).T)

    @cached_property
    def hours(self) -> FloatArray | None:
        """Time since the first dwell, in hours, shape (rows,)."""
        hours = self.dwell_hours
        return None if hours is None else np.repeat(hours, 3)

    @cached_property
    def dwell_hours(self) -> FloatArray | None:
        """The same, shape (dwells,)."""
        time_s = self.observations.time_s
        return None if time_s is None else (time_s - time_s[0]) / 3600.0

    @cached_property
    def temperature_k(self) -> FloatArray | None:
        """Temperature of each channel above the reference, shape (dwells, 3); missing values are the mean."""
        filled = []
        for measured in self.observations.temperatures_degc():
            if measured is None or not np.isfinite(measured).any():
                return None
            known = np.where(np.isfinite(measured), measured, np.nanmean(measured))
            filled.append(known - self.reference_temperature_degc)
        return np.column_stack(filled)

    @cached_property
    def realisation(self) -> NDArray[np.int64]:
        """Number of the realisation of each dwell, from 0."""
        return labels(self.observations.realisations)

    @cached_property
    def outer_direction(self) -> NDArray[np.int64]:
        """Sign of the last move of the outer axis; from the angles where the table does not say."""
        return _direction(self.observations.outer_direction, self.observations.outer_deg)

    @cached_property
    def inner_direction(self) -> NDArray[np.int64]:
        """The same of the inner axis."""
        return _direction(self.observations.inner_direction, self.observations.inner_deg)

    @cached_property
    def left_over_v(self) -> FloatArray:
        """Outputs of the dwell before minus those of this one where it followed directly, else 0, (dwells, 3)."""
        before = np.roll(self.output_v, 1, axis=0) - self.output_v
        return np.where(self._follows[:, None], before, 0.0)

    @property
    def _follows(self) -> NDArray[np.bool_]:
        row, time_s = self.observations.row, self.observations.time_s
        follows = np.diff(row, prepend=row[0] - 2) == 1
        if time_s is not None:
            follows &= np.diff(time_s, prepend=time_s[0]) < PAUSE_S + float(np.median(np.diff(time_s)))
        return np.asarray(follows)

    def turned_v(self, change: FloatArray) -> FloatArray:
        """Volts of all rows for changes of gravity in the case, shape (dwells, 3), per radian: shape (rows,)."""
        return np.asarray((change @ response(self.theta).T).ravel())

    @cached_property
    def outer_v(self) -> FloatArray:
        """Volts per radian of the outer axis, shape (rows,)."""
        level_x = float(self.theta[LEVEL_X])
        vectors = self.directions
        return self.turned_v(np.cos(level_x) * vectors.outer - np.sin(level_x) * vectors.level)

    @cached_property
    def inner_v(self) -> FloatArray:
        """Volts per radian of the inner axis, shape (rows,)."""
        return self.turned_v(inner_change(self.gravity_g))

    def in_channel(self, channel: int, values: FloatArray) -> FloatArray:
        """Values of the dwells, shape (dwells,) or (dwells, n), in one channel, nothing in the others."""
        spread = np.zeros((len(values), 3, *values.shape[1:]))
        spread[:, channel] = values
        return spread.reshape(self.rows, *values.shape[1:])


def _direction(said: NDArray[np.int64] | None, angle_deg: FloatArray) -> NDArray[np.int64]:
    """Sign of the last move of an axis: it keeps its sign while it stands; 0 before the first move."""
    if said is not None:
        return said
    step = np.sign(np.diff(angle_deg, prepend=angle_deg[:1])).astype(np.int64)
    last = np.maximum.accumulate(np.where(step != 0, np.arange(len(step)), 0))
    return np.asarray(step[last])
