"""A Zaber stage in a stand file."""

from pydantic import Field

from tumble.drivers.driver import Bench, Driver
from tumble.drivers.tables import HeadTable, OnSerialLine
from tumble.drivers.zaber.conversation import Line
from tumble.drivers.zaber.head import ZaberHead
from tumble.messages import Message


class ZaberTable(OnSerialLine, HeadTable):
    """`driver = "zaber"`."""

    device: int = Field(default=1, ge=1, le=99)
    """Number in a chain of devices."""
    axis: int = Field(default=1, ge=1, le=9)


def _connect(table: ZaberTable, bench: Bench) -> ZaberHead:
    links = bench.attentive.links
    place = f"zaber {links.name_of(table.url)}"
    line = links.shared(place, lambda: Line(links.serial(table, Message("dividing head"))))
    return ZaberHead(
        line,
        device=table.device,
        axis=table.axis,
        limits_deg=table.limits_deg,
        steps_per_deg=table.steps_per_deg,
        speed_deg_s=table.speed_deg_s,
        clock=bench.clock,
    )


ZABER = Driver(table=ZaberTable, connect=_connect)
