"""How long to average: where the deviation is least, and how well a recording tells that."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.allan.coefficients import NoiseModel
from tumble.calibrations.allan.deviations import LEVEL, dense, deviation_at
from tumble.calibrations.allan.spectrum import lines
from tumble.calibrations.core.arrays import FloatArray

_RECORDINGS: Final = 2000
NEAR: Final = 1.1
"""A deviation of no more than so many times the least one serves as well."""
_SEED: Final = 952


@dataclass(frozen=True, kw_only=True)
class BestTime:
    """The averaging time at which the deviation of one output is least."""

    tau_s: float
    deviation: float
    low_s: float
    high_s: float
    """Between them lie 95% of the minima that other recordings of the same noise would show."""
    longest_s: float
    """The longest averaging time that was tried."""
    curve_tau_s: FloatArray
    curve: FloatArray
    """Deviations at all averaging times that were tried."""

    @property
    def ends(self) -> bool:
        """Whether the interval ends before the longest averaging time: if not, a longer recording may put it later."""
        return self.high_s < self.longest_s


def best_time(values: FloatArray, rate_hz: float, model: NoiseModel) -> BestTime:
    """Where the deviation is least, with the interval by drawing recordings of the noise that was fitted."""
    averages = dense(len(values))
    tau_s, curve = deviation_at(values, rate_hz, averages)
    least = int(np.argmin(curve))
    spectrum = lines(len(values), rate_hz, averages)
    drawn = spectrum.drawn(model.power(spectrum.frequency_hz), _RECORDINGS, np.random.default_rng(_SEED))
    low_s, high_s = np.quantile(
        tau_s[np.argmin(drawn, axis=1)], [(1.0 - LEVEL) / 2.0, (1.0 + LEVEL) / 2.0], method="nearest"
    )
    return BestTime(
        tau_s=float(tau_s[least]),
        deviation=float(curve[least]),
        low_s=float(low_s),
        high_s=float(high_s),
        longest_s=float(tau_s[-1]),
        curve_tau_s=tau_s,
        curve=curve,
    )


def enough_s(models: Sequence[NoiseModel], longest_s: float) -> float | None:
    """The shortest time within a tenth of the best for all outputs that have a floor, by their models.

    The deviation of each is taken relative to its least, and their root mean square is what is to be small. None where
    no output shows flicker or a walk, or where the deviations still fall at the longest time.
    """
    floored = [model for model in models if any(each.value is not None for each in model.coefficients[1:])]
    if not floored:
        return None
    tau_s = np.geomspace(1.0 / floored[0].rate_hz, longest_s, 400)
    curves = np.array([model.deviation(tau_s) for model in floored])
    together = np.sqrt(np.mean((curves / curves.min(axis=1, keepdims=True)) ** 2, axis=0))
    found_s = float(tau_s[int(np.argmax(together <= NEAR * together.min()))])
    return found_s if found_s < longest_s / 2.0 else None
