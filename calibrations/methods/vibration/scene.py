"""What an effect may depend on: everything that is known of each dwell."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import BoolArray, FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.vibration.observations import (
    DOUBLE_CENTRIFUGE,
    MULTI_SHAKER,
    SHAKER,
    VibrationObservations,
)
from tumble.calibrations.methods.vibration.products import mean_products


@dataclass(frozen=True, kw_only=True)
class Point:
    """Where an effect that is not linear is linearised: its value, and the coefficients beside it."""

    value: float
    coefficients: FloatArray
    """K_ii … K_ip, shape (5,), in µg/g²."""


@dataclass(frozen=True, kw_only=True)
class VibrationScene:
    """Dwells as an effect sees them; what the table does not say is None."""

    observations: VibrationObservations
    history: VibrationObservations
    """The same with dwells that are not used, which warmed the unit all the same."""
    points: Mapping[str, Point] = field(default_factory=dict)
    """Of the effects that are not linear, by name."""
    reference_temperature_degc: float = 23.0

    @property
    def rows(self) -> int:
        """How many there are."""
        return len(self.observations)

    @cached_property
    def hours(self) -> FloatArray | None:
        """Time since the first dwell, in hours."""
        time_s = self.observations.time_s
        return None if time_s is None else (time_s - time_s[0]) / 3600.0

    @cached_property
    def products_g2(self) -> FloatArray:
        """Mean products of the vibration, shape (rows, 5)."""
        return mean_products(self.observations)

    @cached_property
    def gravity_g(self) -> FloatArray:
        """Static projections of gravity, shape (rows, 3)."""
        return self.observations.along("g", "_g")

    @cached_property
    def peak_g(self) -> FloatArray:
        """Peaks of the sines along the three axes, shape (rows, 3); 0 where the vibration is random."""
        return self.observations.along("a", "_g") * ~self.observations.random[:, None]

    @cached_property
    def frequency_hz(self) -> FloatArray:
        """Frequency of the sine along the input axis; where there is none, that of the others, and 0 at rest."""
        each = self.observations.along("f", "_hz") * (self.peak_g > 0.0)
        return np.asarray(np.where(each[:, 0] > 0.0, each[:, 0], each.max(axis=1)))

    @cached_property
    def level_g(self) -> FloatArray:
        """Drive level as commanded."""
        return self.observations.level

    @cached_property
    def power_g2(self) -> FloatArray:
        """Mean square of the drive."""
        return mean_square(self.observations)

    @cached_property
    def shaken(self) -> BoolArray:
        """Which rows are of a shaker, one or several."""
        return np.isin(self.observations.of_apparatus, (SHAKER, MULTI_SHAKER))

    @cached_property
    def centrifuged(self) -> BoolArray:
        """Which rows are of a double centrifuge."""
        return np.asarray(self.observations.of_apparatus == DOUBLE_CENTRIFUGE)

    @cached_property
    def temperature_k(self) -> FloatArray | None:
        """Temperature above the reference; missing values are the mean."""
        measured = self.observations.temperature_degc
        if measured is None or not np.isfinite(measured).any():
            return None
        known = np.where(np.isfinite(measured), measured, np.nanmean(measured))
        return np.asarray(known - self.reference_temperature_degc)

    @cached_property
    def realisation(self) -> NDArray[np.int64]:
        """Number of the realisation of each dwell, from 0."""
        return labels(self.observations.realisations)

    @cached_property
    def dwell_s(self) -> FloatArray:
        """How long each dwell lasts; the usual time from dwell to dwell where the table does not say."""
        return durations_s(self.observations)


def mean_square(rows: VibrationObservations) -> FloatArray:
    """Mean square of the drive, in g²: half the square of the level of a sine, the sum of squares of random ones."""
    random = mean_products(rows)[:, :3].sum(axis=1)
    return np.asarray(np.where(rows.random, random, 0.5 * rows.level**2))


def durations_s(rows: VibrationObservations) -> FloatArray:
    """How long each dwell lasts, in seconds."""
    usual = 60.0 if rows.time_s is None or len(rows) < 2 else float(np.median(np.diff(np.sort(rows.time_s))))
    said = rows.filled("dwell_s")
    return np.asarray(np.where(said > 0.0, said, usual))
