"""Blocks of samples, cut into messages of bounded size and put together again."""

from collections.abc import Iterable, Iterator
from typing import Any, TypeAlias

import numpy as np

from tumble.drivers.protocols import SampleBlock
from tumble.procedures.events import SamplesAcquired

Fields: TypeAlias = dict[str, Any]

SAMPLES_PER_MESSAGE = 1000


def split(event: SamplesAcquired) -> Iterator[Fields]:
    """Fields of the messages that hold a block, at most 1,000 samples of one channel each.

    `event.block.voltage_v` has the shape (samples,), or (channels, samples) for a DAQ with several channels.
    """
    block = event.block
    voltage_v = np.ascontiguousarray(np.atleast_2d(block.voltage_v), dtype=np.float64)
    channels, samples = voltage_v.shape
    for first in range(0, max(samples, 1), SAMPLES_PER_MESSAGE):
        for channel in range(channels):
            yield {
                "point": event.point,
                "channel": channel,
                "channels": channels,
                "first_sample": first,
                "samples": samples,
                "time_s": event.time_s,
                "device_time_s": block.device_time_s,
                "rate_hz": block.rate_hz,
                "temperature_degc": block.temperature_degc,
                "voltage_v": voltage_v[channel, first : first + SAMPLES_PER_MESSAGE],
            }


def join(parts: Iterable[Fields]) -> Iterator[SamplesAcquired]:
    """Put blocks together from their messages in the order of `split`; one that lacks a message is left out.

    Holds one block at a time.

    Raises
    ------
    KeyError, TypeError, ValueError
        Where a field is missing or is not what it should be.
    """
    voltage_v, come, point = np.empty((0, 0)), 0, None
    for part in parts:
        channel, first = part["channel"], part["first_sample"]
        if channel == 0 and first == 0:
            voltage_v, come, point = np.empty((part["channels"], part["samples"])), 0, part["point"]
        if part["point"] != point:  # its first message is missing
            continue
        stretch = np.array(part["voltage_v"], dtype=np.float64)
        voltage_v[channel, first : first + len(stretch)] = stretch
        come += len(stretch)
        last = channel == part["channels"] - 1 and first + len(stretch) == part["samples"]
        if last and come == voltage_v.size:
            yield _joined(part, voltage_v)


def _joined(part: Fields, voltage_v: np.ndarray[Any, np.dtype[np.float64]]) -> SamplesAcquired:
    temperature = part.get("temperature_degc")
    block = SampleBlock(
        voltage_v=voltage_v[0] if len(voltage_v) == 1 else voltage_v,
        rate_hz=float(part["rate_hz"]),
        device_time_s=float(part["device_time_s"]),
        temperature_degc=None if temperature is None else float(temperature),
    )
    return SamplesAcquired(point=part["point"], time_s=float(part["time_s"]), block=block)
