"""An emulated temperature chamber on Modbus TCP, around the unit of a simulated world.

Functions 1 to 6, 15 and 16 of the MODBUS Application Protocol (1.1b3, 6), as far as the registers of the stand file go;
whatever else is asked for is answered with the exception that the standard has for it.
"""

import struct
import time
from collections.abc import Callable, Mapping
from typing import Final

from tumble.drivers.chamber.registers import Bit, Quantity, Registers
from tumble.drivers.simulated.chamber import SimulatedChamber
from tumble.emulators.faults import Faults, Kind
from tumble.emulators.world import SharedWorld

REGISTERS: Final = Registers.model_validate(
    {
        "actual": {"input": 0},
        "setpoint": {"holding": 0},
        "run": {"coil": 0},
        "door": {"discrete": 0},
        "door_lock": {"coil": 1},
        "alarm": {"discrete": 1},
    }
)
"""Of a chamber that is only simulated."""
_HEADER: Final = struct.Struct(">HHHB")
"""Transaction, protocol, length of what follows, unit (MODBUS Messaging on TCP/IP 1.0b, 3.1.3)."""
_FORMATS: Final = {"int16": ">h", "uint16": ">H", "int32": ">i", "uint32": ">I", "float32": ">f"}
_BROKEN: Final = {"int16": 32_767, "uint16": 65_535, "int32": 2**31 - 1, "uint32": 2**32 - 1, "float32": 1e30}


def is_whole(data: bytes) -> bool:
    """Whether bytes are a whole request."""
    return len(data) >= 6 and len(data) >= 6 + int.from_bytes(data[4:6], "big")


class ModbusError(Exception):
    """A request that is answered with an exception."""

    def __init__(self, code: int) -> None:
        super().__init__(f"exception {code}")
        self.code = code


class EmulatedChamber:
    """Answers requests by what the chamber of the world says. Fits `tumble.emulators.serving.Session`.

    Parameters
    ----------
    shared
        The world.
    registers
        Which register is what.
    faults
        What goes wrong in it: `door_opened`, `sensor_broken`, `stuck`, `alarm`, `refused`, `power_loss`.
    """

    def __init__(self, shared: SharedWorld, registers: Registers, faults: Faults) -> None:
        self._shared, self._registers, self._faults = shared, registers, faults
        self._chamber: SimulatedChamber = shared.world.chamber
        self._until_s: dict[str, float] = {}
        self._broken = False
        self._functions: Mapping[int, Callable[[int, bytes], bytes]] = {
            1: self._read_bits,
            2: self._read_bits,
            3: self._read_registers,
            4: self._read_registers,
            5: self._write_bit,
            6: self._write_registers,
            15: self._write_bit,
            16: self._write_registers,
        }

    def received(self, data: bytes) -> bytes:
        """Answer a request."""
        transaction, protocol, _, unit = _HEADER.unpack_from(data)
        function, body = data[7], data[8:]
        with self._shared.lock:
            self._suffer()
            try:
                if function not in self._functions:
                    raise ModbusError(1)
                answer = bytes([function]) + self._functions[function](function, body)
            except ModbusError as error:
                answer = bytes([function | 0x80, error.code])
        return _HEADER.pack(transaction, protocol, len(answer) + 1, unit) + answer

    def due(self) -> bytes:
        """Nothing is said unasked."""
        return b""

    def _suffer(self) -> None:
        """Let happen to it what the faults say."""
        chamber = self._chamber
        if self._faults.take("power_loss"):
            chamber.set(chamber.setpoint_degc, running=False)
        chamber.door_open = self._lasts("door_opened")
        chamber.stuck = self._lasts("stuck")
        chamber.alarm = self._lasts("alarm")
        self._broken = self._lasts("sensor_broken")

    def _lasts(self, kind: Kind) -> bool:
        """Whether something that went wrong is so still."""
        if begun := self._faults.take(kind):
            self._until_s[kind] = time.monotonic() + begun.lasts_s
        return time.monotonic() < self._until_s.get(kind, -1.0)

    def _read_registers(self, function: int, body: bytes) -> bytes:
        address, count = struct.unpack(">HH", body)
        words = self._words(holding=function == 3)
        try:
            found = b"".join(words[number] for number in range(address, address + count))
        except KeyError:
            raise ModbusError(2) from None
        return bytes([len(found)]) + found

    def _words(self, *, holding: bool) -> dict[int, bytes]:
        """All registers of a kind, by number."""
        r, status = self._registers, self._chamber.status()
        values = ((r.actual, status.temperature_degc), (r.setpoint, status.setpoint_degc))
        return {
            quantity.address + place: word
            for quantity, degc in values
            if (quantity.holding is not None) is holding
            for place, word in enumerate(self._encoded(quantity, degc))
        }

    def _encoded(self, quantity: Quantity, degc: float) -> list[bytes]:
        broken = self._broken and quantity is self._registers.actual
        count = _BROKEN[quantity.kind] if broken else (degc - quantity.offset) / quantity.scale
        packed = struct.pack(_FORMATS[quantity.kind], count if quantity.kind == "float32" else round(count))
        words = [packed[place : place + 2] for place in range(0, len(packed), 2)]
        return words if quantity.word_order == "big" else words[::-1]

    def _write_registers(self, function: int, body: bytes) -> bytes:
        address = int.from_bytes(body[:2], "big")
        data = body[2:4] if function == 6 else body[5:]
        quantity = self._registers.setpoint
        if address != quantity.address or len(data) != struct.calcsize(_FORMATS[quantity.kind]):
            raise ModbusError(2)
        self._faults.note_command(b"setpoint")
        words = [data[place : place + 2] for place in range(0, len(data), 2)]
        packed = b"".join(words if quantity.word_order == "big" else words[::-1])
        (count,) = struct.unpack(_FORMATS[quantity.kind], packed)
        if not self._faults.take("refused"):
            running = self._chamber.running or self._registers.run is None
            self._chamber.set(quantity.scale * count + quantity.offset, running=running)
        return body[:4]

    def _read_bits(self, function: int, body: bytes) -> bytes:
        address, count = struct.unpack(">HH", body)
        bits = self._bits(coils=function == 1)
        if any(number not in bits for number in range(address, address + count)):
            raise ModbusError(2)
        packed = sum(1 << place for place in range(count) if bits[address + place])
        size = (count + 7) // 8
        return bytes([size]) + packed.to_bytes(size, "little")

    def _bits(self, *, coils: bool) -> dict[int, bool]:
        r, chamber = self._registers, self._chamber
        known: tuple[tuple[Bit | None, bool], ...] = (
            (r.run, chamber.running),
            (r.door, chamber.door_open),
            (r.door_lock, chamber.door_locked),
            (r.alarm, chamber.alarm),
        )
        return {
            bit.address: holds is bit.when
            for bit, holds in known
            if bit is not None and (bit.coil is not None) is coils
        }

    def _write_bit(self, function: int, body: bytes) -> bytes:
        address = int.from_bytes(body[:2], "big")
        on = body[2:4] == b"\xff\x00" if function == 5 else bool(body[5] & 1)
        r, chamber = self._registers, self._chamber
        if r.run is not None and address == r.run.coil:
            self._faults.note_command(b"run")
            chamber.set(chamber.setpoint_degc, running=on is r.run.when)
        elif r.door_lock is not None and address == r.door_lock.coil:
            chamber.lock_door(on is r.door_lock.when)
        else:
            raise ModbusError(2)
        return body[:4]
