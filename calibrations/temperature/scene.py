"""What a parameter may depend on from run to run."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from calibrations.geometry import FloatArray


@dataclass(frozen=True, kw_only=True)
class RunScene:
    """Runs as an effect sees them."""

    temperature_degc: FloatArray
    order: FloatArray
    """Which run was made when, shape (runs,)."""
    hours: FloatArray | None = None
    """Time since the first run; None where the table does not say."""

    @property
    def rows(self) -> int:
        """How many runs there are."""
        return len(self.temperature_degc)

    @cached_property
    def relative(self) -> FloatArray:
        """Temperature over its range, from -1 to 1."""
        low, high = float(self.temperature_degc.min()), float(self.temperature_degc.max())
        return np.asarray((2.0 * self.temperature_degc - low - high) / (high - low))

    @cached_property
    def between_degc(self) -> FloatArray:
        """Temperatures between which runs lie on both sides, in quarters of the way from each run to the next."""
        known = np.unique(self.temperature_degc)
        inside = known[1:-1]
        fine = np.linspace(inside[0], inside[-1], 4 * (len(inside) - 1) + 1) if len(inside) > 1 else inside
        return np.asarray(fine)
