"""The frames of a CAN DAQ: what a DBC file says of them, and the checksum that it may put into them."""

import math
from binascii import crc_hqx
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Final, Literal, Self

from cantools.database import load_string
from cantools.database.can import Database, Message
from cantools.database.errors import Error
from cantools.database.namedsignalvalue import NamedSignalValue

OVERLOAD_V: Final = 9.9e37
"""How the value named Overload is told, as SCPI instruments do."""

Value = float | str
"""A signal's value; where the DBC file gives it a name, that name."""

SIGNALS: Final[dict[str, tuple[str, ...]]] = {
    "Command": ("Epoch", "Samples", "Rate"),
    "Started": ("Epoch", "Samples", "Rate"),
    "Voltage": ("Voltage", "Counter", "Epoch"),
    "Identity": ("Serial", "Product", "Firmware"),
}
"""Messages that a DBC file must have, and the signals in them."""

OPTIONAL_SIGNALS: Final[dict[str, tuple[str, ...]]] = {
    "Temperature": ("Temperature", "Epoch"),
    "Time": ("Time", "Epoch"),
}
"""Messages that it may have. Every message may also have a signal named CRC."""

_CRC_START: Final = 0xFFFF
_CRC_BITS: Final = 16


@dataclass(frozen=True, kw_only=True)
class Frame:
    """A frame that was received whole: the name of its message and its signals."""

    name: str
    signals: Mapping[str, Value]

    def number(self, signal: str) -> float:
        """Value of a signal; infinite where it says Overload, NaN where it has another name or is missing."""
        value = self.signals.get(signal, "Invalid")
        if isinstance(value, str):
            return OVERLOAD_V if value == "Overload" else float("nan")
        return value


class DaqFrames:
    """Encodes and decodes the frames of a DAQ whose DBC file uses the names in `SIGNALS`.

    Identifiers, places, scales and byte orders are the file's. A signal named CRC holds the CRC-16/CCITT-FALSE
    (polynomial 1021h, start FFFFh) of the identifier, two bytes or, extended, four, low byte first, and of the frame's
    other bytes; it must be 16 bits wide and begin at a byte. It sees up to three wrong bits; where it is the frame's
    end, high byte first, also every burst of 16 bits.

    Raises
    ------
    ValueError
        The database lacks what is needed.
    """

    def __init__(self, database: Database) -> None:
        self._messages = {message.name: message for message in database.messages}
        for name, signals in SIGNALS.items():
            if name not in self._messages:
                raise ValueError(f"the DBC file has no message {name}; see the one that comes along for all names")
            self._require(name, signals)
        for name, signals in OPTIONAL_SIGNALS.items():
            if name in self._messages:
                self._require(name, signals)
        names = (*SIGNALS, *OPTIONAL_SIGNALS)
        self._by_id = {m.frame_id: m for m in self._messages.values() if m.name in names}
        self._most_v = self._messages["Voltage"].get_signal_by_name("Voltage").maximum or OVERLOAD_V
        self._checksum_at = {m.name: _checksum_at(m) for m in self._by_id.values()}

    @classmethod
    def from_file(cls, path: Path | None = None) -> Self:
        """Read a DBC file, or the one that comes along. Raises `OSError`, `ValueError`."""
        file = path or files("drivers.candaq") / "tumble_daq.dbc"
        try:
            database = load_string(file.read_text("utf-8"), "dbc")
        except Error as error:
            raise ValueError(f"{path} is no DBC file ({error})") from error
        assert isinstance(database, Database)
        return cls(database)

    def has(self, name: str) -> bool:
        """Whether the DAQ has a message of this name."""
        return name in self._messages

    def encode(self, name: str, signals: Mapping[str, Value]) -> tuple[int, bytes]:
        """Identifier and bytes of a frame. Raises `ValueError` for a value that does not fit."""
        message = self._messages[name]
        at = self._checksum_at[name]
        values = dict(signals) if at is None else {**signals, "CRC": 0}
        try:
            data = bytearray(message.encode(values, strict=False))
        except (Error, OverflowError) as error:
            raise ValueError(f"{name}: {error}") from error
        if at is not None:
            data[at : at + 2] = _checksum(message, data, at).to_bytes(2, _order(message))
        return message.frame_id, bytes(data)

    def encode_voltage(self, voltage_v: float, number: int, epoch: int) -> tuple[int, bytes]:
        """A voltage frame; NaN goes as Invalid, what the signal cannot hold as Overload."""
        voltage: Value = voltage_v
        if math.isnan(voltage_v):
            voltage = "Invalid"
        elif abs(voltage_v) > self._most_v:
            voltage = "Overload"
        return self.encode("Voltage", {"Voltage": voltage, "Counter": number % 256, "Epoch": epoch})

    def decode(self, can_id: int, data: bytes) -> Frame | None:
        """What a frame says; None where it is not the DAQ's, or its length or checksum is wrong."""
        message = self._by_id.get(can_id)
        if message is None or len(data) != message.length:
            return None
        at = self._checksum_at[message.name]
        if at is not None and int.from_bytes(data[at : at + 2], _order(message)) != _checksum(message, data, at):
            return None
        decoded = message.decode_simple(data)
        return Frame(name=message.name, signals={name: _plain(value) for name, value in decoded.items()})

    def _require(self, name: str, signals: tuple[str, ...]) -> None:
        present = {signal.name for signal in self._messages[name].signals}
        for signal in signals:
            if signal not in present:
                raise ValueError(f"message {name} of the DBC file has no signal {signal}")


def _checksum_at(message: Message) -> int | None:
    """Number of the byte at which the checksum begins; None where there is none."""
    for signal in message.signals:
        if signal.name == "CRC":
            first = 0 if signal.byte_order == "little_endian" else 7
            if signal.length != _CRC_BITS or signal.start % 8 != first:
                raise ValueError(f"signal CRC of message {message.name} is not two whole bytes")
            return signal.start // 8
    return None


def _order(message: Message) -> Literal["little", "big"]:
    return "little" if message.get_signal_by_name("CRC").byte_order == "little_endian" else "big"


def _checksum(message: Message, data: bytes | bytearray, at: int) -> int:
    identifier = message.frame_id.to_bytes(4 if message.is_extended_frame else 2, "little")
    return crc_hqx(identifier + data[:at] + data[at + 2 :], _CRC_START)


def _plain(value: float | str | NamedSignalValue) -> Value:
    return value.name if isinstance(value, NamedSignalValue) else value
