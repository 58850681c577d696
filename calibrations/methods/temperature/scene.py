"""What a parameter may depend on from run to run."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.clusters import clusters

_ROUNDINGS_K = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
"""How closely a temperature may be set again."""


def temperature_numbers(temperature_degc: FloatArray) -> NDArray[np.int64]:
    """Number of the temperature of each run, from 0 upwards; those that a chamber sets alike share one."""
    return clusters(temperature_degc, _ROUNDINGS_K)


@dataclass(frozen=True, kw_only=True)
class RunScene:
    """Runs as an effect sees them."""

    temperature_degc: FloatArray
    order: FloatArray
    """Which run was made when, shape (runs,)."""
    direction: NDArray[np.int64]
    """1 where the run before was colder, -1 where it was warmer, 0 of the first, shape (runs,)."""
    hours: FloatArray | None = None
    """Time since the first run; None where the table does not say."""
    range_degc: tuple[float, float] | None = None
    """Over which polynomials are taken; None: that of the runs."""

    def only(self, kept: NDArray[np.bool_]) -> "RunScene":
        """Some of the runs."""
        hours = None if self.hours is None else self.hours[kept]
        return replace(
            self,
            temperature_degc=self.temperature_degc[kept],
            order=self.order[kept],
            direction=self.direction[kept],
            hours=hours,
        )

    def over(self, other: "RunScene") -> "RunScene":
        """The same runs, seen over the range of others."""
        low, high = float(other.temperature_degc.min()), float(other.temperature_degc.max())
        return replace(self, range_degc=(low, high))

    @cached_property
    def at(self) -> NDArray[np.int64]:
        """Number of the temperature of each run, from 0 upwards, shape (runs,)."""
        return temperature_numbers(self.temperature_degc)

    @cached_property
    def known_degc(self) -> FloatArray:
        """Temperatures that were visited, ascending: runs carry no more numbers than there are of them."""
        return np.asarray(np.bincount(self.at, weights=self.temperature_degc) / np.bincount(self.at))

    @cached_property
    def both_ways(self) -> int:
        """How many temperatures were reached by heating and by cooling."""
        sides = [set(self.direction[self.at == number].tolist()) for number in range(len(self.known_degc))]
        return sum({1, -1} <= side for side in sides)

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
        known = self.known_degc
        inside = known[1:-1]
        fine = np.linspace(inside[0], inside[-1], 4 * (len(inside) - 1) + 1) if len(inside) > 1 else inside
        return np.asarray(fine)
