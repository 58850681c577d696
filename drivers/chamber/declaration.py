"""A temperature chamber on Modbus TCP in a stand file."""

from typing import TYPE_CHECKING

from tumble.drivers.chamber.table import ModbusChamberTable
from tumble.drivers.driver import Bench, Driver

if TYPE_CHECKING:  # pymodbus takes time, for stands that have a chamber
    from tumble.drivers.chamber.modbus import ModbusChamber


def _connect(table: ModbusChamberTable, bench: Bench) -> "ModbusChamber":
    from tumble.drivers.chamber.modbus import ModbusChamber

    chamber = ModbusChamber(table, bench.check)
    bench.links.at_end(chamber.close)
    return chamber


MODBUS = Driver(table=ModbusChamberTable, connect=_connect)
