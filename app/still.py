"""The still recording that a run holds: its first dwell, where that tells how the noise falls with averaging."""

from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path

import numpy as np

from tumble.calibrations.allan.deviations import FEWEST_SAMPLES
from tumble.calibrations.allan.recording import StillRecording
from tumble.calibrations.core.arrays import FloatArray
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.recording.reader import iter_samples


def read_still_dwell(path: Path) -> StillRecording:
    """The first dwell of a recording; all dwells of a run last equally long.

    Raises
    ------
    RecordingError
        As `read_recording`.
    InputError
        There is none that would tell anything.
    """
    still = still_dwell(path)
    if still is None:
        raise InputError(
            Message(
                "{path}: its first dwell has fewer than {fewest} samples, or an output that never changes or was not "
                "always there; the noise is told by one long dwell in which nothing moves",
                path=path,
                fewest=FEWEST_SAMPLES,
            )
        )
    return still


def still_dwell(path: Path) -> StillRecording | None:
    """The first dwell of a recording; None where it would tell nothing. Raises `RecordingError`."""
    blocks = list(_first_blocks(path))
    outputs: dict[str, FloatArray] = {_column(name): values for _, each in blocks for name, values in each.items()}
    rates_hz, lengths = {rate_hz for rate_hz, _ in blocks}, {len(values) for values in outputs.values()}
    if len(rates_hz) != 1 or len(lengths) != 1:
        return None
    still = StillRecording(outputs=outputs, rate_hz=rates_hz.pop(), source=str(path))
    return still if _tells(still) else None


def _first_blocks(path: Path) -> Iterator[tuple[float, dict[str, FloatArray]]]:
    """Rate and outputs of each sampler in the first dwell."""
    acquired = iter_samples(path)
    first = next(acquired, None)
    if first is None:
        return
    for each in (first, *takewhile(lambda other: other.point == first.point, acquired)):
        yield each.block.rate_hz, {**each.block.channels}


def _column(channel: str) -> str:
    """The output as tables call it, its unit in capitals."""
    return channel.removesuffix("v") + "V" if channel.endswith("_v") else channel


def _tells(still: StillRecording) -> bool:
    whole = (bool(np.isfinite(values).all() and np.ptp(values) > 0.0) for values in still.outputs.values())
    return still.samples >= FEWEST_SAMPLES and all(whole)
