"""The rows of a head that is measured against a reference, as dwells; how far the reference stands from the head."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.observations import HeadObservations
from tumble.messages import Message

DWELL_S = 0.1
"""Rows that follow each other more closely are samples, and are taken together to dwells so long: neighbouring samples
err alike, and so many of them say no more than their mean."""


def error_deg(observations: HeadObservations) -> FloatArray:
    """Reference minus head, shape (rows,), in degrees, free of wraps: within half a turn of its mean direction.

    Raises
    ------
    ValueError
        The table holds no reference.
    """
    if observations.reference_deg is None:
        raise ValueError(Message("{source}: there is no column reference_deg", source=observations.source))
    away_deg = observations.reference_deg - observations.angle_deg
    middle_deg = float(np.rad2deg(np.angle(np.mean(np.exp(1j * np.deg2rad(away_deg))))))
    return np.asarray((away_deg - middle_deg + 180.0) % 360.0 - 180.0 + middle_deg)


@dataclass(frozen=True, kw_only=True)
class Dwells:
    """A table as dwells, and the samples of which they are means where it was a stream of them."""

    observations: HeadObservations
    """One row for each dwell; the reference does not wrap."""
    samples: HeadObservations
    """As they were taken; the dwells themselves where those are what the table holds."""
    number: NDArray[np.int64]
    """Dwell of each sample, from 0."""

    @property
    def streamed(self) -> bool:
        """Whether the table was a stream of samples."""
        return len(self.samples) > len(self.observations)

    def angle_before_deg(self, late_s: float, velocity_deg_s: FloatArray) -> FloatArray:
        """Angle of the head so long before each dwell, shape (dwells,); of a stream as it moved, else by its speed."""
        time_s = self.samples.time_s
        if not self.streamed or time_s is None:
            return np.asarray(self.observations.angle_deg - velocity_deg_s * late_s)
        before_deg = np.interp(time_s - late_s, time_s, self.samples.angle_deg)
        moved_deg = np.where(_after_gap(time_s, late_s), -late_s * velocity_deg_s[self.number], 0.0)
        return self._means(np.where(moved_deg != 0.0, self.samples.angle_deg + moved_deg, before_deg))

    def _means(self, values: FloatArray) -> FloatArray:
        return np.asarray(np.bincount(self.number, weights=values) / np.bincount(self.number))


def as_they_are(observations: HeadObservations) -> Dwells:
    """Rows that are dwells already, their reference free of wraps."""
    return Dwells(observations=observations, samples=observations, number=np.arange(len(observations)))


def as_dwells(observations: HeadObservations) -> Dwells:
    """Take samples that follow each other within less than `DWELL_S` together; other tables are dwells already.

    A dwell holds samples of one realisation and one direction only; the speed of a stream follows from its angles and
    times where the table does not say. Raises `ValueError` without a reference.
    """
    unwrapped = replace(observations, reference_deg=observations.angle_deg + error_deg(observations))
    time_s = observations.time_s
    if time_s is None or len(time_s) < 2 or np.median(np.diff(time_s)) > DWELL_S / 2:
        return as_they_are(unwrapped)
    if unwrapped.velocity_deg_s is None:
        unwrapped = replace(unwrapped, velocity_deg_s=np.gradient(observations.angle_deg, time_s))
    number = _numbers(observations, time_s)
    return Dwells(observations=unwrapped.averaged(number), samples=unwrapped, number=number)


def _numbers(observations: HeadObservations, time_s: FloatArray) -> NDArray[np.int64]:
    """Number of the dwell of each row, from 0."""
    step = np.sign(np.diff(observations.angle_deg, prepend=observations.angle_deg[0]))
    keys = np.column_stack([np.floor((time_s - time_s[0]) / DWELL_S + 1e-6), observations.realisations, step])
    return np.cumsum(np.any(np.diff(keys, axis=0, prepend=keys[:1]) != 0, axis=1))


def _after_gap(time_s: FloatArray, late_s: float) -> NDArray[np.bool_]:
    """Whether rows are missing just before a sample, so that only its speed says where the head was."""
    step_s = np.diff(time_s, prepend=time_s[0] - 2 * late_s)
    begins = np.maximum.accumulate(np.where(step_s > 3 * np.median(step_s), np.arange(len(time_s)), 0))
    return np.asarray(time_s - time_s[begins] < late_s)
