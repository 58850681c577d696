"""A DAQ on CAN in a stand file."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cantools.database.can import Database
from pydantic import Field, model_validator

from tumble.drivers.candaq.daq import CanDaq
from tumble.drivers.candaq.frames import DaqFrames
from tumble.drivers.candaq.free import FreeRunningDaq
from tumble.drivers.candaq.naming import SignalNames, load_dbc
from tumble.drivers.candaq.several import SeveralChannels
from tumble.drivers.driver import Bench, Driver
from tumble.drivers.names import GivenName
from tumble.drivers.tables import DaqTable, OnCan
from tumble.messages import Message


class CanDaqTable(OnCan, DaqTable):
    """`driver = "can"`."""

    dbc: str = ""
    """DBC file, relative to the stand file; without it the one that comes along."""
    signals: dict[str, dict[str, str]] = Field(default_factory=dict)
    """What the DBC file calls the signals, where it has names of its own, see `tumble.drivers.candaq.naming`."""

    voltages: dict[GivenName, str] = Field(default_factory=dict)
    """`MESSAGE.SIGNAL` by channel, of a DAQ that sends several by itself."""
    quantities: dict[GivenName, str] = Field(default_factory=dict)
    """The same of channels that are no voltages, whose names end with their units (`_deg_h`, `_deg`)."""
    temperatures: dict[GivenName, str] = Field(default_factory=dict)
    """`MESSAGE.SIGNAL` of the thermometer of a channel, as far as it has one."""
    counter: str = ""
    """Signal that goes up by one in every message of a channel that has it."""
    checksum: str = ""
    """Signal that holds the checksum of every message of a channel that has it, see `Checksum`."""
    identity: dict[str, str] = Field(default_factory=dict)
    """`MESSAGE.SIGNAL` of Product, Serial and Firmware, where it sends these by itself."""

    @model_validator(mode="after")
    def _one_way(self) -> "CanDaqTable":
        if self.channel_signals and self.signals:
            raise ValueError(Message("name the signals under voltages or quantities, or under signals, and not both"))
        if twice := sorted(self.voltages.keys() & self.quantities.keys()):
            raise ValueError(Message("{name} is among voltages and quantities: name it once", name=twice[0]))
        if stray := sorted(self.temperatures.keys() - self.channel_signals.keys()):
            raise ValueError(
                Message("temperatures names {name}, which is none of voltages or quantities: correct it", name=stray[0])
            )
        return self

    @model_validator(mode="after")
    def _of_a_file(self) -> "CanDaqTable":
        if (self.signals or self.channel_signals) and not self.dbc:
            raise ValueError(Message("signals are named, and no DBC file that has them: give dbc, too"))
        return self

    @property
    def channel_signals(self) -> dict[str, str]:
        """`MESSAGE.SIGNAL` by channel, of a DAQ that sends several by itself."""
        return {**self.voltages, **self.quantities}


def frames_of(table: CanDaqTable, folder: Path) -> DaqFrames:
    """The frames of a DAQ; paths are relative to `folder`. Raises `ValueError`."""
    return _frames(table, folder, table.signals)


def channel_frames(table: CanDaqTable, folder: Path) -> dict[str, DaqFrames]:
    """The frames of every channel of a DAQ that sends several by itself, in order. Raises `ValueError`."""
    present = {message.name: {each.name for each in message.signals} for message in database_of(table, folder).messages}
    found: dict[str, DaqFrames] = {}
    for name, place in table.channel_signals.items():
        message, own = place.rpartition(".")[0], {"Voltage": place}
        for signal, there in (("Counter", table.counter), ("CRC", table.checksum)):
            if there in present.get(message, ()):
                own[signal] = f"{message}.{there}"
        signals = {"Voltage": own}
        if name in table.temperatures:
            signals["Temperature"] = {"Temperature": table.temperatures[name]}
        if table.identity and not found:
            signals["Identity"] = table.identity
        found[name] = _frames(table, folder, signals, name if name in table.quantities else "")
    return found


def database_of(table: CanDaqTable, folder: Path) -> Database:
    """The DBC file of a DAQ that names its signals. Raises `ValueError`."""
    with _told_of(folder / table.dbc):
        return load_dbc(folder / table.dbc, strict=False)


def _frames(table: CanDaqTable, folder: Path, signals: SignalNames, channel: str = "") -> DaqFrames:
    path = folder / table.dbc if table.dbc else None
    with _told_of(path):
        return DaqFrames.from_file(path, signals, channel)


@contextmanager
def _told_of(path: Path | None) -> Iterator[None]:
    try:
        yield
    except (OSError, ValueError) as error:
        raise ValueError(
            Message("{path}: {error}; name the DBC file of the DAQ in the stand file", path=path, error=error)
        ) from error


def _connect(table: CanDaqTable, bench: Bench) -> CanDaq | FreeRunningDaq | SeveralChannels:
    if table.channel_signals:
        return _several(table, bench)
    frames = frames_of(table, bench.folder)
    kind = FreeRunningDaq if frames.free_running else CanDaq
    return kind(bench.links.can(table), frames, bench.clock, bench.links.check)


def _several(table: CanDaqTable, bench: Bench) -> SeveralChannels:
    """A DAQ that sends several channels by itself: one of one channel for each of them."""
    frames, link = channel_frames(table, bench.folder), bench.links.can(table)
    channels = {name: FreeRunningDaq(link, each, bench.clock, bench.links.check) for name, each in frames.items()}
    return SeveralChannels(channels, {name: frames[name].range for name in table.quantities})


CAN = Driver(table=CanDaqTable, connect=_connect)
