"""A voltmeter with a scanner in a stand file."""

from typing import Annotated, Self, TypeAlias

from pydantic import Field, model_validator

from tumble.drivers.driver import Bench, Driver
from tumble.drivers.names import GivenName
from tumble.drivers.scpi.scanner import Scanner
from tumble.drivers.tables import DaqTable, OnSerialLine
from tumble.messages import Message

ChannelNumber: TypeAlias = Annotated[int, Field(ge=101, le=999)]


class ScannerTable(OnSerialLine, DaqTable):
    """`driver = "scanner"`."""

    scan: dict[GivenName, ChannelNumber] = Field(min_length=1)
    """Number of the scanner's channel (101: slot 1, channel 1) by the name of what is measured there, `u_x_v`, say."""
    thermometers: dict[GivenName, ChannelNumber] = Field(default_factory=dict)
    """Number of the channel with the thermometer of each of them, as far as there is one."""
    temperature_sensor: str = "FRTD,85"
    """Parameters of `CONF:TEMP` before the channel list."""
    range_v: float = Field(default=10.0, gt=0.0, le=300.0)

    @model_validator(mode="after")
    def _of_the_scan(self) -> Self:
        for name in self.thermometers:
            if name not in self.scan:
                known = ", ".join(self.scan)
                raise ValueError(Message("thermometers names {name}, and scan has {known}", name=name, known=known))
        numbers = [*self.scan.values(), *self.thermometers.values()]
        if twice := next((number for number in numbers if numbers.count(number) > 1), None):
            raise ValueError(Message("channel {number} is named twice: give each its own", number=twice))
        return self


def _connect(table: ScannerTable, bench: Bench) -> Scanner:
    return Scanner(
        bench.links.serial(table, "scanner"),
        bench.clock,
        scan=table.scan,
        thermometers=table.thermometers,
        sensor=table.temperature_sensor,
        range_v=table.range_v,
        baud_rate=table.baud_rate,
    )


SCANNER = Driver(table=ScannerTable, connect=_connect)
