"""A CiA 402 drive in a stand file."""

from pydantic import Field

from tumble.drivers.cia402.head import Cia402Head
from tumble.drivers.driver import Bench, Driver
from tumble.drivers.tables import HeadTable, OnCan


class Cia402Table(OnCan, HeadTable):
    """`driver = "cia402"`."""

    node: int = Field(default=1, ge=1, le=127)
    """Number on CANopen."""


def _connect(table: Cia402Table, bench: Bench) -> Cia402Head:
    return Cia402Head(
        bench.links.can(table),
        table.node,
        limits_deg=table.limits_deg,
        steps_per_deg=table.steps_per_deg,
        speed_deg_s=table.speed_deg_s,
        clock=bench.clock,
        check=bench.check,
    )


CIA402 = Driver(table=Cia402Table, connect=_connect)
