"""Settings of a head: which dwells stand at the same angle, reached in the same direction and at the same speed."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.clusters import as_they_come, clusters
from tumble.calibrations.core.repeats import SAME_ANGLE_DEG, PureError, labels, pure_error
from tumble.calibrations.methods.head_reference.scene import HeadScene

_ROUNDINGS_DEG = (SAME_ANGLE_DEG, 0.05, 0.1, 0.2, 0.5)
"""How closely an angle may be set again; the closest is taken at which most of the settings come back."""
_SPEED_STEPS = 20.0
"""Speeds closer than the greatest of a table by this are one."""


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Dwells by setting."""

    number: NDArray[np.int64]
    """Setting of each dwell, from 0, in the order in which they were first visited."""
    streamed: bool = False
    """Whether the dwells are pieces of a stream: neighbours err alike and are no repeats of each other."""

    @cached_property
    def visits(self) -> NDArray[np.int64]:
        """How often each setting was visited, shape (settings,)."""
        return np.asarray(np.bincount(self.number))

    @property
    def repeated(self) -> bool:
        """Whether any setting was visited more than once, so that repeats say what the noise is."""
        return not self.streamed and len(self.number) > len(self.visits)

    def means(self, values: FloatArray) -> FloatArray:
        """Mean of each setting, shape (settings,), of values of the dwells."""
        return np.asarray(np.bincount(self.number, weights=values) / self.visits)

    def within(self, values: FloatArray) -> FloatArray:
        """What each dwell differs by from the mean of its setting, shape (rows,)."""
        return np.asarray(values - self.means(values)[self.number])

    def pure_error(self, values: FloatArray) -> PureError:
        """Pooled variance of one dwell between the repeats of a setting, in the square of the unit of the values."""
        return pure_error(values, self.number, np.ones(len(values)))

    def others(self, row: int) -> NDArray[np.int64]:
        """The other visits to the setting of a dwell."""
        same = np.flatnonzero(self.number == self.number[row])
        return np.asarray(same[same != row])


def head_settings(scene: HeadScene) -> Settings:
    """Group the dwells of a table by angle (any revolution by itself), direction and speed."""
    columns: list[NDArray[np.generic]] = [angle_numbers(scene.angle_deg), scene.direction]
    if (speed := scene.velocity_deg_s) is not None and np.abs(speed).max() > 0:
        columns.append(np.round(_SPEED_STEPS * speed / np.abs(speed).max()))
    return Settings(number=as_they_come(labels(*columns)), streamed=scene.dwells.streamed)


def angle_numbers(angle_deg: FloatArray) -> NDArray[np.int64]:
    """Number of the angle of each dwell, from 0 upwards; those that lie within a rounding of each other share one."""
    return clusters(angle_deg, _ROUNDINGS_DEG)
