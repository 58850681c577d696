"""What a parameter may depend on from run to run."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from calibrations.geometry import FloatArray


@dataclass(frozen=True, kw_only=True)
class RunScene:
    """Runs as an effect sees them."""

    temperature_degc: FloatArray
    order: FloatArray
    """Which run was made when, shape (runs,)."""
    hours: FloatArray | None = None
    """Time since the first run; None where the table does not say."""
    range_degc: tuple[float, float] | None = None
    """Over which polynomials are taken; None: that of the runs."""

    def only(self, kept: NDArray[np.bool_]) -> "RunScene":
        """Some of the runs."""
        hours = None if self.hours is None else self.hours[kept]
        return replace(self, temperature_degc=self.temperature_degc[kept], order=self.order[kept], hours=hours)

    def over(self, other: "RunScene") -> "RunScene":
        """The same runs, seen over the range of others."""
        low, high = float(other.temperature_degc.min()), float(other.temperature_degc.max())
        return replace(self, range_degc=(low, high))

    @property
    def rows(self) -> int:
        """How many runs there are."""
        return len(self.temperature_degc)

    @cached_property
    def relative(self) -> FloatArray:
        """Temperature over its range, from -1 to 1."""
        low, high = self.range_degc or (float(self.temperature_degc.min()), float(self.temperature_degc.max()))
        return np.asarray((2.0 * self.temperature_degc - low - high) / (high - low))

    @cached_property
    def between_degc(self) -> FloatArray:
        """Temperatures between which runs lie on both sides, in quarters of the way from each run to the next."""
        known = np.unique(self.temperature_degc)
        inside = known[1:-1]
        fine = np.linspace(inside[0], inside[-1], 4 * (len(inside) - 1) + 1) if len(inside) > 1 else inside
        return np.asarray(fine)
