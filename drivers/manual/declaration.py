"""A head without a motor in a stand file."""

from typing import ClassVar, Final

from pydantic import Field

from tumble.drivers.driver import Bench, Driver
from tumble.drivers.manual.head import ManualHead
from tumble.drivers.tables import HeadTable

ARCSEC_PER_DEG: Final = 3600.0


class ManualTable(HeadTable):
    """`driver = "manual"`."""

    by_hand: ClassVar[bool] = True

    setting_tolerance_arcsec: float = Field(default=60.0, gt=0.0)
    """A reading that differs from the setting by more is asked for again."""


def _connect(table: ManualTable, bench: Bench) -> ManualHead:
    return ManualHead(
        bench.eyepiece(table.setting_tolerance_arcsec / ARCSEC_PER_DEG),
        bench.clock,
        limits_deg=table.limits_deg,
        speed_deg_s=table.speed_deg_s,
        serial=table.serial,
    )


MANUAL = Driver(table=ManualTable, connect=_connect)
