"""The samplers of a stand: each takes its block in turn, and every block is whole."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Block, ChannelBlock, FloatArray, Sampler, Stand
from tumble.messages import Message
from tumble.procedures.losses import Losses


class Sampling:
    """Acquires with all samplers of a stand."""

    def __init__(self, stand: Stand, losses: Losses) -> None:
        self._stand = stand
        self._losses = losses

    def blocks(self, samples: int, rate_hz: float) -> tuple[Block, ...]:
        """A block of every sampler, taken one after the other. Raises `DeviceError`."""
        return tuple(self._blocks(samples, rate_hz))

    def channels(self, samples: int, rate_hz: float) -> dict[str, FloatArray]:
        """The same, by channel. Raises `DeviceError`."""
        return channels_of(self.blocks(samples, rate_hz))

    def _blocks(self, samples: int, rate_hz: float) -> Iterator[Block]:
        for name, sampler in self._stand.samplers.items():
            title, names = self._stand.title(name), self._stand.channels.get(name)
            with self._losses.using(name):
                block = acquire(sampler, samples, rate_hz, title)
                block = renamed(block, names, title) if names else block
            yield block


def acquire(sampler: Sampler, samples: int, rate_hz: float, title: str) -> Block:
    """Acquire a block and make sure that it is complete. Raises `DeviceError`, which calls the sampler `title`."""
    block = sampler.acquire(samples, rate_hz)
    for values in block.channels.values():
        if len(values) != samples:
            happened = Message.counted(
                "gave {given} of {count} sample", "gave {given} of {count} samples", given=len(values), count=samples
            )
            raise DeviceError(title, happened, Message("check its trigger and its connection, then resume the run"))
    return block


def renamed(block: Block, names: Sequence[str], title: str) -> Block:
    """The block with other names for its channels, in their order. Raises `DeviceError` where it has more or fewer."""
    if len(names) != len(block.channels):
        happened = Message.counted(
            "gives {count} channel, and the stand file names {named}",
            "gives {count} channels, and the stand file names {named}",
            count=len(block.channels),
            named=len(names),
        )
        raise DeviceError(title, happened, Message("correct channels of the stand file"))
    by_new_name = dict(zip(names, block.channels, strict=True))
    own_degc = block.temperatures_degc
    return ChannelBlock(
        channels={name: block.channels[own] for name, own in by_new_name.items()},
        temperatures_degc={name: own_degc[own] for name, own in by_new_name.items() if own in own_degc},
        rate_hz=block.rate_hz,
        device_time_s=block.device_time_s,
        temperature_degc=block.temperature_degc,
    )


def channels_of(blocks: Iterable[Block]) -> dict[str, FloatArray]:
    """The samples of several blocks by channel. Raises `DeviceError` where two of them have one of the same name."""
    channels: dict[str, FloatArray] = {}
    for block in blocks:
        if twice := sorted(channels.keys() & block.channels.keys()):
            raise DeviceError(
                Message("stand"),
                Message("has two samplers with a channel {twice}", twice=twice[0]),
                Message("give one of them another name"),
            )
        channels |= block.channels
    return channels


def wanted(channels: Mapping[str, FloatArray], names: Iterable[str]) -> dict[str, FloatArray]:
    """The channels that a dwell asks for. Raises `DeviceError` where the stand has no such one."""
    try:
        return {name: channels[name] for name in names}
    except KeyError as missing:
        there = ", ".join(channels) or Message("none")
        raise DeviceError(
            Message("stand"),
            Message("gives no channel {missing}, only {there}", missing=missing, there=there),
            Message("name it in the stand file"),
        ) from missing
