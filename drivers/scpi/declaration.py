"""A SCPI multimeter in a stand file."""

from typing import Literal

from pydantic import Field

from tumble.drivers.driver import Bench, Driver
from tumble.drivers.scpi.meter import ScpiMultimeter
from tumble.drivers.tables import DaqTable, OnSerialLine


class ScpiTable(OnSerialLine, DaqTable):
    """`driver = "scpi"`."""

    range_v: float | None = Field(default=10.0, gt=0.0, le=1000.0)
    dialect: Literal["common"] | None = None
    """`common`: a meter that is not known by name is used by the SCPI that all have, one query a message."""
    temperature_sensor: str | None = None
    """Parameters of `CONF:TEMP`; without them there is no temperature."""


def _connect(table: ScpiTable, bench: Bench) -> ScpiMultimeter:
    return ScpiMultimeter(
        bench.links.serial(table, "multimeter"),
        bench.clock,
        range_v=table.range_v,
        temperature_sensor=table.temperature_sensor,
        baud_rate=table.baud_rate,
        common=table.dialect == "common",
    )


SCPI = Driver(table=ScpiTable, connect=_connect)
