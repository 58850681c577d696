"""The keys of `[chamber]` for a chamber on Modbus TCP."""

from typing import Final, Self
from urllib.parse import urlsplit

from pydantic import Field, model_validator

from tumble.drivers.chamber.registers import Registers
from tumble.drivers.tables import ChamberTable
from tumble.messages import Message

MODBUS_PORT: Final = 502


class ModbusChamberTable(ChamberTable):
    """`driver = "modbus"`; `url` is `socket://HOST:PORT`, port 502 where none is given."""

    unit: int = Field(default=1, ge=0, le=255)
    """Number of the unit behind the address."""
    registers: Registers
    timeout_s: float = Field(default=1.0, gt=0.0, le=60.0)
    """How long an answer may take, in real time."""

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        if urlsplit(self.url).scheme != "socket" or not self.place[0]:
            raise ValueError(Message("the driver modbus needs a url such as socket://192.168.1.30:502"))
        return self

    @property
    def place(self) -> tuple[str, int]:
        """Host and port."""
        parts = urlsplit(self.url)
        return parts.hostname or "", MODBUS_PORT if parts.port is None else parts.port
