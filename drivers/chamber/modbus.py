"""A temperature chamber on Modbus TCP, by pymodbus."""

import logging
import math
import select
import socket
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any, Final, TypeVar

from pymodbus import ModbusException
from pymodbus.client import ModbusTcpClient
from pymodbus.pdu import ModbusPDU

from tumble.drivers.chamber.registers import Bit, Quantity
from tumble.drivers.chamber.table import ModbusChamberTable
from tumble.drivers.errors import DeviceError, LimitError, LinkLostError
from tumble.drivers.links.opening import opened_unless_stopped
from tumble.drivers.protocols import EnvironmentStatus, Identity
from tumble.messages import Message

DEVICE: Final = Message("temperature chamber")
TRIES: Final = 3
"""How often what is asked is asked again; writing the same value twice is the same as writing it once."""
_SLICE_S: Final = 0.05
"""One wait without a look, in real time."""
PLAUSIBLE_DEGC: Final = (-200.0, 1000.0)
"""A sensor that is broken reads as the end of its scale."""
_EXCEPTIONS: Final = {
    1: Message("it does not know this kind of request"),
    2: Message("it has no such register"),
    3: Message("it refuses this value"),
    4: Message("it failed"),
    6: Message("it is busy"),
}
"""MODBUS Application Protocol 1.1b3, 7."""

Answer = TypeVar("Answer")

logging.getLogger("pymodbus.logging").setLevel(logging.CRITICAL)  # what it reports is raised here


class _Client(ModbusTcpClient):
    """A client that looks many times a second, while it awaits an answer, at whether it shall go on waiting."""

    def __init__(self, table: ModbusChamberTable, check: Callable[[], object]) -> None:
        host, port = table.place
        super().__init__(host, port=port, timeout=table.timeout_s, retries=TRIES - 1)
        self._check = check

    def connect(self) -> bool:
        """Open the connection, unless there is one; returns whether there is one now. Raises what `check` raises."""
        if self.socket is None:
            wanted = self.comm_params
            place = wanted.host, wanted.port
            open_it = partial(socket.create_connection, place, wanted.timeout_connect)
            with suppress(OSError):
                self.socket = opened_unless_stopped(
                    open_it, self._check, socket.socket.close, f"{wanted.host}:{wanted.port}"
                )
        return self.socket is not None

    def recv(self, size: int | None) -> bytes:
        """Wait for bytes as pymodbus does, once there are any or its patience is at its end.

        What `check` raises closes the connection, and the answer that is on its way with it.
        """
        deadline_s = time.monotonic() + self.comm_params.timeout_connect
        while self.socket and time.monotonic() < deadline_s:
            self._look()
            if select.select([self.socket], [], [], _SLICE_S)[0]:
                return super().recv(size)
        return b"" if self.socket else super().recv(size)

    def _look(self) -> None:
        try:
            self._check()
        except BaseException:
            self.close()  # type: ignore[no-untyped-call]
            raise


class ModbusChamber:
    """Fits `tumble.drivers.protocols.Environment` and `Reconnectable`.

    Every set point is read back. Nothing is sent before it is first asked for something.

    Parameters
    ----------
    table
        The stand file's table: address, registers, limits.
    check
        Called many times a second while an answer is awaited; what it raises breaks the wait off.
    """

    def __init__(self, table: ModbusChamberTable, check: Callable[[], object] = lambda: None) -> None:
        self._table = table
        self._client = _Client(table, check)
        self._told_degc: float | None = None

    @property
    def limits_degc(self) -> tuple[float, float]:
        """Set points that may be asked for, checked before anything is sent."""
        return self._table.limits_degc

    @property
    def ramp_k_per_min(self) -> float | None:
        """The steepest change of the set point."""
        return self._table.ramp_k_per_min

    def identify(self) -> Identity:
        """Make sure that it answers; its model and number are those of the stand file. Raises `DeviceError`."""
        self.status()
        return Identity(model="Modbus TCP chamber", serial=self._table.serial)

    def reconnect(self) -> None:
        """Open the connection anew. Raises `LinkLostError` while it is away."""
        self._client.close()  # type: ignore[no-untyped-call]
        if not self._client.connect():
            raise self._lost(Message("nobody is there"))

    def close(self) -> None:
        """Leave it as it is."""
        self._client.close()  # type: ignore[no-untyped-call]

    def begin(self, setpoint_degc: float) -> None:
        """Run towards a set point. Raises `LimitError`, `DeviceError`."""
        low_degc, high_degc = self.limits_degc
        if not low_degc <= setpoint_degc <= high_degc:
            raise LimitError(
                DEVICE,
                Message(
                    "{setpoint:g} °C is outside {low:g} to {high:g} °C",
                    setpoint=setpoint_degc,
                    low=low_degc,
                    high=high_degc,
                ),
                Message("change the temperatures, or limits_degC of the stand"),
            )
        self._set(setpoint_degc)
        self._switch(self._table.registers.run, on=True)

    def status(self) -> EnvironmentStatus:
        """Read everything back. Raises `DeviceError`."""
        registers = self._table.registers
        temperature_degc = self._number(registers.actual)
        low_degc, high_degc = PLAUSIBLE_DEGC
        if not low_degc < temperature_degc < high_degc:
            raise DeviceError(
                DEVICE,
                Message("says that its air has {degc:g} °C", degc=temperature_degc),
                Message("look at its sensor, and at kind and scale of registers.actual"),
            )
        return EnvironmentStatus(
            temperature_degc=temperature_degc,
            setpoint_degc=self._number(registers.setpoint),
            door_open=self._told(registers.door),
            alarm=self._told(registers.alarm),
            running=registers.run is None or self._told(registers.run),
        )

    def lock_door(self, locked: bool) -> None:
        """Keep the door shut, or let it be opened; nothing where it has no lock. Raises `DeviceError`."""
        self._switch(self._table.registers.door_lock, on=locked)

    def make_safe(self) -> None:
        """Go to the safe set point, or stop. Raises `DeviceError`."""
        if self._table.safe_degc is None:
            self._switch(self._table.registers.run, on=False)
        else:
            self._set(self._table.safe_degc)

    def _set(self, setpoint_degc: float) -> None:
        quantity = self._table.registers.setpoint
        count = (setpoint_degc - quantity.offset) / quantity.scale
        value = count if quantity.kind == "float32" else round(count)
        words = self._client.convert_to_registers(value, self._kind(quantity), quantity.word_order)
        self._asked(lambda: self._client.write_registers(quantity.address, words, device_id=self._table.unit))
        back_degc = self._number(quantity)
        if not math.isclose(back_degc, setpoint_degc, abs_tol=abs(quantity.scale) + 1e-3):
            raise DeviceError(
                DEVICE,
                Message("was told {setpoint:g} °C and has {back:g} °C", setpoint=setpoint_degc, back=back_degc),
                Message("look whether it is set to be told by network, then resume the run"),
            )

    def _number(self, quantity: Quantity) -> float:
        read = self._client.read_input_registers if quantity.holding is None else self._client.read_holding_registers
        kind = self._kind(quantity)
        reply = self._asked(lambda: read(quantity.address, count=kind.value[1], device_id=self._table.unit))
        counts = self._client.convert_from_registers(reply.registers, kind, quantity.word_order)
        assert isinstance(counts, int | float)
        return quantity.scale * counts + quantity.offset

    def _told(self, bit: Bit | None) -> bool:
        """Whether that holds of which a bit tells; false where there is none."""
        if bit is None:
            return False
        read = self._client.read_discrete_inputs if bit.coil is None else self._client.read_coils
        reply = self._asked(lambda: read(bit.address, count=1, device_id=self._table.unit))
        return bool(reply.bits[0]) is bit.when

    def _switch(self, bit: Bit | None, *, on: bool) -> None:
        if bit is not None:
            value = on is bit.when
            self._asked(lambda: self._client.write_coil(bit.address, value, device_id=self._table.unit))

    def _asked(self, ask: Callable[[], ModbusPDU]) -> Any:  # noqa: ANN401  # registers or bits, as it was asked
        """What it answers. Raises `LinkLostError` where it does not, `DeviceError` where it refuses."""
        try:
            reply = ask()
        except (ModbusException, OSError) as error:
            self._client.close()  # type: ignore[no-untyped-call]
            raise self._lost(str(error).removeprefix("Modbus Error: ")) from error
        if reply.isError():
            code = int(getattr(reply, "exception_code", 0))
            why = _EXCEPTIONS.get(code, Message("exception {code}", code=code))
            raise DeviceError(
                DEVICE,
                Message("answers with an error: {why}", why=why),
                Message("compare registers of the stand file with its manual, then resume the run"),
            )
        return reply

    def _kind(self, quantity: Quantity) -> ModbusTcpClient.DATATYPE:
        return ModbusTcpClient.DATATYPE[quantity.kind.upper()]

    def _lost(self, why: str) -> LinkLostError:
        return LinkLostError(
            DEVICE,
            Message("does not answer at {url} ({why})", url=self._table.url, why=why),
            Message("check its power and its network; the run can be resumed"),
        )
