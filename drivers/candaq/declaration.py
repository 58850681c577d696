"""A DAQ on CAN in a stand file."""

from pathlib import Path

from pydantic import Field, model_validator

from tumble.drivers.candaq.daq import CanDaq
from tumble.drivers.candaq.frames import DaqFrames
from tumble.drivers.candaq.free import FreeRunningDaq
from tumble.drivers.driver import Bench, Driver
from tumble.drivers.tables import DaqTable, OnCan
from tumble.messages import Message


class CanDaqTable(OnCan, DaqTable):
    """`driver = "can"`."""

    dbc: str = ""
    """DBC file, relative to the stand file; without it the one that comes along."""
    signals: dict[str, dict[str, str]] = Field(default_factory=dict)
    """What the DBC file calls the signals, where it has names of its own, see `tumble.drivers.candaq.naming`."""

    @model_validator(mode="after")
    def _of_a_file(self) -> "CanDaqTable":
        if self.signals and not self.dbc:
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


def _connect(table: CanDaqTable, bench: Bench) -> CanDaq | FreeRunningDaq:
    frames = frames_of(table, bench.folder)
    kind = FreeRunningDaq if frames.free_running else CanDaq
    return kind(bench.links.can(table), frames, bench.clock)


CAN = Driver(table=CanDaqTable, connect=_connect)
