"""What an effect may depend on: everything that is known of each row once the declared model is fitted."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import mountings

PAUSE_S = 60.0
"""Two dwells further apart than this did not follow directly on one another."""
_STEPS = 33
"""In how many places the way from one pose to the next is looked at for turning points."""


@dataclass(frozen=True, kw_only=True)
class Scene:
    """Rows as an effect sees them; what the table does not say is None."""

    observations: Observations
    alpha0_deg: float
    output_v: FloatArray
    """Output by the fit, shape (rows,): free of noise, as close to the truth as the fit is."""
    slope_v_per_deg: FloatArray
    """Change of the output with the true angle, shape (rows,)."""
    response_v_per_g: FloatArray
    """Change of the output with ax, ay and az, by the fit, shape (3,)."""
    reference_temperature_degc: float = 23.0
    product_v_per_g2: float = 0.0
    """Change of the output with ax ay, by the fit."""

    @property
    def rows(self) -> int:
        """How many there are."""
        return len(self.observations)

    @cached_property
    def gravity_g(self) -> FloatArray:
        """Projections ax, ay, az, shape (rows, 3)."""
        return projections(self.observations.mounts, self.observations.true_angle_deg + self.alpha0_deg)

    @cached_property
    def ax_g(self) -> FloatArray:
        """Projection on the input axis, shape (rows,)."""
        return np.asarray(self.gravity_g[:, 0])

    @property
    def angle_deg(self) -> FloatArray:
        """Head angle as reported."""
        return self.observations.angle_deg

    @cached_property
    def hours(self) -> FloatArray | None:
        """Time since the first row, in hours."""
        time_s = self.observations.time_s
        return None if time_s is None else (time_s - time_s[0]) / 3600.0

    @cached_property
    def temperature_k(self) -> FloatArray | None:
        """Temperature above the reference, in kelvin; missing values are the mean."""
        measured = self.observations.temperature_degc
        if measured is None or not np.isfinite(measured).any():
            return None
        filled = np.where(np.isfinite(measured), measured, np.nanmean(measured))
        return np.asarray(filled - self.reference_temperature_degc)

    @cached_property
    def direction(self) -> NDArray[np.int64]:
        """Sign of the last move of the head; from the angles where the table does not say, 0 where nothing does.

        Seating the unit anew turns no head: it comes from the angle before, and where it stays, so does the sign.
        """
        if self.observations.direction is not None:
            return self.observations.direction
        step = np.sign(np.diff(self.angle_deg, prepend=self.angle_deg[:1])).astype(np.int64)
        begins = np.diff(self.observations.runs, prepend=-1) != 0
        last = np.maximum.accumulate(np.where((step != 0) | begins, np.arange(len(step)), 0))
        return np.asarray(np.where(begins, 0, step)[last])

    @cached_property
    def realisation(self) -> NDArray[np.int64]:
        """Number of the realisation of each row, from 0."""
        return labels(self.observations.realisations)

    @cached_property
    def mounting(self) -> NDArray[np.int64]:
        """Number of the mounting of each row, from 0."""
        return mountings(self.observations)

    def play(self, reach_g: float) -> FloatArray:
        """Where a play of half width `reach_g` stands within its slack, from -1 to 1, shape (rows,).

        -1 once ax has risen by twice the reach, 1 once it has fallen so far. The head is taken to have gone straight
        from each pose to the next. Each mounting starts in the middle of the slack, where the head stood before: a hand
        that turns a unit from one mount into another takes it through anything.
        """
        return self._dragged(reach_g, self._remounted)

    def play_kept(self, reach_g: float) -> FloatArray:
        """The same where the unit went straight from one mount into the other, and only the first starts so."""
        return self._dragged(reach_g, np.arange(self.rows) == 0)

    def _dragged(self, reach_g: float, begins: NDArray[np.bool_]) -> FloatArray:
        contact, found = 0.0, []
        for turns, begun in zip(self._ax_on_the_way, begins.tolist(), strict=True):
            contact = turns[0] if begun else contact
            for ax_g in turns:
                contact = min(max(contact, ax_g - reach_g), ax_g + reach_g)
            found.append(contact)
        return (np.array(found) - self.ax_g) / reach_g

    @cached_property
    def _ax_on_the_way(self) -> list[list[float]]:
        """Ax where the head stood before each pose, at every turning point on the way, and at the pose itself."""
        mounts, angle_deg = self.observations.mounts, self.observations.true_angle_deg + self.alpha0_deg
        fine = np.linspace(0.0, 1.0, _STEPS)
        before_deg = np.concatenate([angle_deg[:1], angle_deg[:-1]])
        way_deg = before_deg[:, None] + (angle_deg - before_deg)[:, None] * fine
        ax_g = projections(np.repeat(mounts, _STEPS), way_deg.ravel())[:, 0].reshape(way_deg.shape)
        turning = np.zeros(ax_g.shape, dtype=bool)
        turning[:, 1:-1] = np.diff(np.sign(np.diff(ax_g, axis=1)), axis=1) != 0
        turning[:, [0, -1]] = True
        return [ax_g[row, turning[row]].tolist() for row in range(len(ax_g))]

    @cached_property
    def left_over_v(self) -> FloatArray:
        """Output of the previous dwell minus that of this one where it followed directly, else 0."""
        return np.asarray(np.where(self._follows, np.roll(self.output_v, 1) - self.output_v, 0.0))

    @property
    def variance_v2(self) -> FloatArray | None:
        """Variance of the samples within the dwell."""
        deviation = self.observations.voltage_sd_v
        if deviation is None or not np.isfinite(deviation).all():
            return None
        return np.asarray(deviation**2)

    @property
    def _remounted(self) -> NDArray[np.bool_]:
        """Whether the unit was seated anew, or the table begins, just before the row."""
        return np.asarray(np.diff(self.mounting, prepend=-1) != 0)

    @property
    def _follows(self) -> NDArray[np.bool_]:
        """Where one dwell followed on the other: in one mount without a pause, also where another run began between.

        Where no time is known, a run begins after a pause.
        """
        gap = np.diff(self.observations.row, prepend=self.observations.row[0]) > 1
        if self.hours is None:
            return np.asarray(~self._remounted & ~gap)
        pause = np.diff(self.hours, prepend=-np.inf) * 3600.0 > PAUSE_S
        mounts = self.observations.mounts
        return np.asarray((mounts == np.roll(mounts, 1)) & ~pause & ~gap)
