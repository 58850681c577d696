"""From the samples of a dwell to its mean."""

import math
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.rows import OVERLOAD
from tumble.drivers.protocols import SampleBlock


@dataclass(frozen=True, kw_only=True)
class Reduction:
    """Mean and scatter of a block; both NaN where a sample is unusable, so that the analysis sets the point aside."""

    voltage_v: float
    """Mean of the samples, in volts."""
    voltage_sd_v: float
    """Standard deviation of the single samples, divisor n - 1, in volts."""
    samples: int
    unusable: int
    """How many of the samples are not finite or overloads."""


def reduce_block(block: SampleBlock) -> Reduction:
    """Reduce a block of at least two samples."""
    voltage_v = block.voltage_v
    samples = len(voltage_v)
    usable = int(np.count_nonzero(np.abs(voltage_v) <= OVERLOAD))  # false for NaN, too
    if usable < samples:
        return Reduction(voltage_v=math.nan, voltage_sd_v=math.nan, samples=samples, unusable=samples - usable)
    mean_v = float(voltage_v.mean())
    deviation_v = voltage_v - mean_v
    sd_v = math.sqrt(float(deviation_v @ deviation_v) / (samples - 1))
    return Reduction(voltage_v=mean_v, voltage_sd_v=sd_v, samples=samples, unusable=0)
