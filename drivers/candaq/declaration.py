"""A DAQ on CAN in a stand file."""

from pathlib import Path

from pydantic import Field, model_validator

from tumble.drivers.candaq.daq import CanDaq
from tumble.drivers.candaq.frames import DaqFrames
from tumble.drivers.candaq.free import FreeRunningDaq
from tumble.drivers.candaq.several import SeveralVoltages
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
    temperatures: dict[GivenName, str] = Field(default_factory=dict)
    """`MESSAGE.SIGNAL` of the thermometer of a channel, as far as it has one."""

    @model_validator(mode="after")
    def _one_way(self) -> "CanDaqTable":
        if self.voltages and self.signals:
            raise ValueError(Message("name the signals under voltages, or under signals, and not both"))
        if stray := sorted(self.temperatures.keys() - self.voltages.keys()):
            raise ValueError(Message("temperatures names {name}, which is none of voltages: correct it", name=stray[0]))
        return self

    @model_validator(mode="after")
    def _of_a_file(self) -> "CanDaqTable":
        if (self.signals or self.voltages) and not self.dbc:
            raise ValueError(Message("signals are named, and no DBC file that has them: give dbc, too"))
        return self


def frames_of(table: CanDaqTable, folder: Path) -> DaqFrames:
    """The frames of a DAQ; paths are relative to `folder`. Raises `ValueError`."""
    path = folder / table.dbc if table.dbc else None
    try:
        return DaqFrames.from_file(path, table.signals)
    except (OSError, ValueError) as error:
        raise ValueError(
            Message("{path}: {error}; name the DBC file of the DAQ in the stand file", path=path, error=error)
        ) from error


def _connect(table: CanDaqTable, bench: Bench) -> CanDaq | FreeRunningDaq | SeveralVoltages:
    if table.voltages:
        return _several(table, bench)
    frames = frames_of(table, bench.folder)
    kind = FreeRunningDaq if frames.free_running else CanDaq
    return kind(bench.links.can(table), frames, bench.clock)


def _several(table: CanDaqTable, bench: Bench) -> SeveralVoltages:
    """A DAQ that sends several voltages by itself: one of one voltage for each of them."""
    link, channels = bench.links.can(table), {}
    for name, place in table.voltages.items():
        signals = {"Voltage": {"Voltage": place}}
        if name in table.temperatures:
            signals["Temperature"] = {"Temperature": table.temperatures[name]}
        frames = frames_of(table.model_copy(update={"signals": signals}), bench.folder)
        channels[name] = FreeRunningDaq(link, frames, bench.clock)
    return SeveralVoltages(channels)


CAN = Driver(table=CanDaqTable, connect=_connect)
