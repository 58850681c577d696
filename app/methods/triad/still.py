"""The still recording that runs of a triad hold: a dwell so long that it tells how the noise falls with averaging."""

from collections.abc import Iterator
from itertools import takewhile
from typing import Final

import numpy as np

from tumble.app.measurement import Measurement
from tumble.calibrations.allan.deviations import FEWEST_SAMPLES
from tumble.calibrations.allan.recording import StillRecording
from tumble.calibrations.core.arrays import FloatArray
from tumble.procedures.methods.triad.layout import CHANNELS
from tumble.procedures.recording.reader import iter_samples

STILL_S: Final = 600.0
"""A dwell that lasts so long is a still recording."""


def still_of(measurement: Measurement) -> StillRecording | None:
    """The first dwell of the recording whose dwells are longest; None of tables, and where none lasts long enough."""
    recordings = (each for each in (measurement, *measurement.others) if each.header is not None)
    found = [still for each in recordings if (still := _first_dwell(each)) is not None]
    return max(found, key=lambda still: still.duration_s, default=None)


def _first_dwell(measurement: Measurement) -> StillRecording | None:
    blocks = list(_first_blocks(measurement))
    outputs: dict[str, FloatArray] = {name: values for _, channels in blocks for name, values in channels.items()}
    rates_hz, lengths = {rate_hz for rate_hz, _ in blocks}, {len(values) for values in outputs.values()}
    if not set(CHANNELS) <= outputs.keys() or len(rates_hz) > 1 or len(lengths) > 1:
        return None
    still = StillRecording(
        outputs={_column(name): outputs[name] for name in CHANNELS},
        rate_hz=rates_hz.pop(),
        source=str(measurement.path),
    )
    return still if still.duration_s >= STILL_S and _tells(still) else None


def _first_blocks(measurement: Measurement) -> Iterator[tuple[float, dict[str, FloatArray]]]:
    """Rate and outputs of each sampler in the first dwell."""
    acquired = iter_samples(measurement.path)
    first = next(acquired, None)
    if first is None:
        return
    for each in (first, *takewhile(lambda other: other.point == first.point, acquired)):
        yield each.block.rate_hz, {**each.block.channels}


def _column(channel: str) -> str:
    """The output as tables call it, its unit in capitals."""
    return channel.removesuffix("v") + "V"


def _tells(still: StillRecording) -> bool:
    whole = (bool(np.isfinite(values).all() and np.ptp(values) > 0.0) for values in still.outputs.values())
    return still.samples >= FEWEST_SAMPLES and all(whole)
