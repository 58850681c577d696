"""Blocks of samples, cut into messages of bounded size and put together again."""

from collections.abc import Iterable, Iterator
from typing import Any, TypeAlias

import numpy as np

from tumble.drivers.protocols import VOLTAGE, Block, ChannelBlock, FloatArray, SampleBlock
from tumble.procedures.events import SamplesAcquired

Fields: TypeAlias = dict[str, Any]

SAMPLES_PER_MESSAGE = 1000


def split(event: SamplesAcquired) -> Iterator[Fields]:
    """Fields of the messages that hold a block, at most 1,000 samples of one channel each."""
    block = event.block
    samples = max(map(len, block.channels.values()), default=0)
    for first in range(0, max(samples, 1), SAMPLES_PER_MESSAGE):
        for number, (name, values) in enumerate(block.channels.items()):
            yield {
                "point": event.point,
                "take": take_of(event.take),
                "channel": number,
                "channels": len(block.channels),
                "first_sample": first,
                "samples": samples,
                "time_s": event.time_s,
                "device_time_s": block.device_time_s,
                "rate_hz": block.rate_hz,
                "temperature_degc": block.temperature_degc,
                **_named(name, values[first : first + SAMPLES_PER_MESSAGE]),
            }


def join(parts: Iterable[Fields]) -> Iterator[SamplesAcquired]:
    """Put blocks together from their messages in the order of `split`; one that lacks a message is left out.

    Holds one block at a time.

    Raises
    ------
    KeyError, TypeError, ValueError
        Where a field is missing or is not what it should be.
    """
    values, come, point = np.empty((0, 0)), 0, None
    names: dict[int, str] = {}
    for part in parts:
        channel, first = part["channel"], part["first_sample"]
        if channel == 0 and first == 0:
            values, come, point, names = np.empty((part["channels"], part["samples"])), 0, part["point"], {}
        if part["point"] != point:  # its first message is missing
            continue
        names[channel], stretch = _name(part), _stretch(part)
        values[channel, first : first + len(stretch)] = stretch
        come += len(stretch)
        last = channel == part["channels"] - 1 and first + len(stretch) == part["samples"]
        if last and come == values.size:
            channels = {names[number]: row for number, row in enumerate(values)}
            yield _event(part, _joined(part, channels))


def take_of(take: int) -> int | None:
    """As a message has it: left out where it is the first."""
    return take if take > 1 else None


def _event(part: Fields, block: Block) -> SamplesAcquired:
    return SamplesAcquired(point=part["point"], time_s=float(part["time_s"]), block=block, take=part.get("take", 1))


def _named(name: str, stretch: FloatArray) -> Fields:
    """Samples of a channel under its name; a voltmeter's only channel needs none."""
    values = np.ascontiguousarray(stretch, dtype=np.float64)
    return {"voltage_v": values} if name == VOLTAGE else {"name": name, "values": values}


def _name(part: Fields) -> str:
    """Name of a channel; version 0.1 numbered those of a voltmeter with several."""
    unnamed = VOLTAGE if part["channels"] == 1 else f"voltage_{part['channel'] + 1}_v"
    return str(part.get("name", unnamed))


def _stretch(part: Fields) -> FloatArray:
    return np.array(part["values"] if "name" in part else part["voltage_v"], dtype=np.float64)


def _joined(part: Fields, channels: dict[str, FloatArray]) -> Block:
    temperature = part.get("temperature_degc")
    rate_hz, device_time_s = float(part["rate_hz"]), float(part["device_time_s"])
    temperature_degc = None if temperature is None else float(temperature)
    if channels.keys() == {VOLTAGE}:
        return SampleBlock(
            voltage_v=channels[VOLTAGE],
            rate_hz=rate_hz,
            device_time_s=device_time_s,
            temperature_degc=temperature_degc,
        )
    return ChannelBlock(
        channels=channels, rate_hz=rate_hz, device_time_s=device_time_s, temperature_degc=temperature_degc
    )
