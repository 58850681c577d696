"""A DAQ on CAN in a stand file."""

from drivers.candaq.daq import CanDaq
from drivers.candaq.frames import DaqFrames
from drivers.driver import Bench, Driver
from drivers.tables import DaqTable, OnCan


class CanDaqTable(OnCan, DaqTable):
    """`driver = "can"`."""

    dbc: str = ""
    """DBC file, relative to the stand file; without it the one that comes along."""


def _connect(table: CanDaqTable, bench: Bench) -> CanDaq:
    path = bench.folder / table.dbc if table.dbc else None
    try:
        frames = DaqFrames.from_file(path)
    except (OSError, ValueError) as error:
        raise ValueError(f"{path}: {error}; name the DBC file of the DAQ in the stand file") from error
    return CanDaq(bench.links.can(table), frames, bench.clock)


CAN = Driver(table=CanDaqTable, connect=_connect)
