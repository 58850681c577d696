"""The course of a run: where the head stood at every dwell, when, how it came there, and what surrounded it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from benchmarks.blind.geometry import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, kw_only=True)
class Run:
    """Everything but the unit; every field has a value for each row (contract, observations.md)."""

    angle_deg: FloatArray
    """Head angle as reported, φ."""
    time_s: FloatArray
    """Middle of the dwell, from the first row."""
    realisation: IntArray
    procedure: NDArray[np.str_]
    mount: NDArray[np.str_]
    direction: IntArray
    """Sign of the last move of the head; 0: unknown."""
    temperature_degc: FloatArray
    """True temperature of the unit."""
    noise_v: FloatArray
    """Standard deviation of a dwell's mean."""
    voltage_sd_v: FloatArray
    """Standard deviation of the samples within the dwell, as recorded."""
    fresh: BoolArray
    """Rows of later realisations, which the table does not hold: those that predictions are judged on."""

    @cached_property
    def seating(self) -> IntArray:
        """Number of the mounting: an unbroken run of rows with one mount, from 0 (effects.md, `seating`)."""
        return np.cumsum(np.r_[False, self.mount[1:] != self.mount[:-1]]).astype(np.int64)

    @cached_property
    def since_seating_s(self) -> FloatArray:
        """Time since the first row of the mounting."""
        first = np.unique(self.seating, return_index=True)[1]
        return self.time_s - self.time_s[first][self.seating]

    @cached_property
    def place(self) -> IntArray:
        """Place of the row in its realisation, from 0."""
        first = np.unique(self.realisation, return_index=True)[1]
        return np.arange(len(self.time_s)) - first[np.searchsorted(np.unique(self.realisation), self.realisation)]

    @cached_property
    def follows(self) -> BoolArray:
        """Whether the dwell followed directly on the row before: no mounting between (effects.md, `settling`)."""
        return np.asarray(np.r_[False, self.seating[1:] == self.seating[:-1]])

    @cached_property
    def span_s(self) -> float:
        """Time from the first to the last row of the table."""
        return float(self.time_s[~self.fresh][-1])

    def centred(self, values: FloatArray) -> FloatArray:
        """Return values less their mean over the rows of the table."""
        return np.asarray(values - values[~self.fresh].mean())
