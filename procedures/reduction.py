"""From the samples of a dwell to their means."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from tumble.calibrations.core.rows import OVERLOAD
from tumble.drivers.protocols import Block, FloatArray
from tumble.procedures.steps import Reading


def reduce_samples(values: FloatArray) -> Reading:
    """Mean and scatter of at least two samples of one channel, shape (samples,).

    Both are NaN where a sample is unusable, so that the analysis sets the point aside.
    """
    samples = len(values)
    if count_unusable(values):
        return Reading(mean=math.nan, sd=math.nan, samples=samples)
    mean = float(values.mean())
    deviation = values - mean
    return Reading(mean=mean, sd=math.sqrt(float(deviation @ deviation) / (samples - 1)), samples=samples)


def count_unusable(values: FloatArray) -> int:
    """How many samples are not finite, or overloads."""
    usable = int(np.count_nonzero(np.abs(values) <= OVERLOAD))  # false for NaN, too
    return len(values) - usable


def with_temperatures(readings: Mapping[str, Reading], blocks: Iterable[Block]) -> dict[str, Reading]:
    """Readings with the temperatures of those channels that have a thermometer of their own."""
    own_degc = {name: degc for block in blocks for name, degc in block.temperatures_degc.items()}
    return {name: replace(reading, temperature_degc=own_degc.get(name)) for name, reading in readings.items()}


def reduce_channels(channels: Mapping[str, FloatArray]) -> dict[str, Reading]:
    """Reduce every channel, by name."""
    return {name: reduce_samples(values) for name, values in channels.items()}
