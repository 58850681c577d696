"""The frames of a CAN DAQ: what a DBC file says of them, and the checksum that it may put into them."""

import math
from collections import defaultdict
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib.resources import as_file, files
from pathlib import Path
from typing import Final, Self

from cantools.database.can import Database
from cantools.database.errors import Error
from cantools.database.namedsignalvalue import NamedSignalValue

from tumble.drivers.candaq.checksum import Checksum
from tumble.drivers.candaq.naming import CRC, Part, SignalNames, load_dbc, named_parts, own_parts
from tumble.drivers.candaq.units import unit_of
from tumble.messages import Message

OVERLOAD_V: Final = 9.9e37
"""How the value named Overload is told, as SCPI instruments do."""

_COUNTED: Final = ("Counter", "Epoch")

Value = float | str
"""A signal's value; where the DBC file gives it a name, that name."""


class SpoiltFrameError(ValueError):
    """A frame with an identifier of the DAQ is not what the DBC file says; the text is the kind, in the plural."""


@dataclass(frozen=True, kw_only=True)
class Frame:
    """A frame that was received whole: the name of its message and its signals, as they are called here."""

    name: str
    signals: Mapping[str, Value]

    def number(self, signal: str) -> float:
        """Value of a signal; infinite where it says Overload, NaN where it has another name or is missing."""
        value = self.signals.get(signal, "Invalid")
        if isinstance(value, str):
            return OVERLOAD_V if value == "Overload" else float("nan")
        return value


class DaqFrames:
    """Encodes and decodes the frames of a DAQ.

    Identifiers, places, scales and byte orders are the DBC file's; a signal named CRC is heeded, see `Checksum`.

    Parameters
    ----------
    database
        The DBC file.
    names
        What it calls the messages and signals; by default the names in `SIGNALS`.
    channel
        What is measured, where that is no voltage: the name ends with its unit, see `tumble.drivers.quantities`.

    Raises
    ------
    ValueError
        The database lacks what is needed.
    """

    def __init__(self, database: Database, names: SignalNames | None = None, channel: str = "") -> None:
        parts = named_parts(database, names) if names else own_parts(database)
        self._parts = {part.name: part for part in parts}
        self._by_id: dict[int, list[Part]] = defaultdict(list)
        for part in parts:
            self._by_id[part.message.frame_id].append(part)
        self._checksums = {
            part.name: Checksum(part.message, part.signals[CRC]) for part in parts if CRC in part.signals
        }
        self._units = {
            (part.name, name): unit_of(name, signal, channel) for part in parts for name, signal in part.signals.items()
        }
        voltage = self._parts["Voltage"]
        most = voltage.signals["Voltage"].maximum
        self._most_v = self._units["Voltage", "Voltage"].to_ours(float(most)) if most else OVERLOAD_V
        self.range = self._range(voltage)
        """Where the measured value may be, as far as the DBC file says it."""
        self.counts = 1 << voltage.signals["Counter"].length if "Counter" in voltage.signals else 0
        """How far the counter of the voltage frames counts before it begins again at 0; 0 where there is none."""

    @classmethod
    def from_file(cls, path: Path | None = None, names: SignalNames | None = None, channel: str = "") -> Self:
        """Read a DBC file, or the one that comes along. Raises `OSError`, `ValueError`."""
        if path is not None:
            return cls(load_dbc(path, strict=not names), names, channel)
        return cls(_ours(), names, channel)

    def _range(self, measured: Part) -> tuple[float, float]:
        signal, unit = measured.signals["Voltage"], self._units["Voltage", "Voltage"]
        if signal.minimum is None or signal.maximum is None or signal.minimum >= signal.maximum:
            return -math.inf, math.inf
        return unit.to_ours(float(signal.minimum)), unit.to_ours(float(signal.maximum))

    @property
    def free_running(self) -> bool:
        """Whether the DAQ sends without being told to begin."""
        return "Command" not in self._parts

    def has(self, name: str) -> bool:
        """Whether the DAQ has a message of this name."""
        return name in self._parts

    def place_of(self, name: str) -> str:
        """What the DBC file calls a message."""
        return self._parts[name].message.name

    def encode(self, name: str, signals: Mapping[str, Value]) -> tuple[int, bytes]:
        """Identifier and bytes of a frame. Raises `ValueError` for a value that does not fit."""
        part, checksum = self._parts[name], self._checksums.get(name)
        told = {part.signals[s].name: self._theirs(name, s, value) for s, value in signals.items() if s in part.signals}
        rest: dict[str, Value] = {signal.name: 0.0 for signal in part.message.signals if signal.name not in told}
        try:
            data = part.message.encode(rest | told, strict=False)
        except (Error, OverflowError) as error:
            raise ValueError(Message("{name}: {error}", name=name, error=error)) from error
        return part.message.frame_id, data if checksum is None else checksum.put_into(data)

    def encode_voltage(self, voltage_v: float, number: int, epoch: int) -> tuple[int, bytes]:
        """A voltage frame; NaN goes as Invalid, what the signal cannot hold as Overload."""
        voltage: Value = voltage_v
        if math.isnan(voltage_v):
            voltage = "Invalid"
        elif abs(voltage_v) > self._most_v:
            voltage = "Overload"
        return self.encode("Voltage", {"Voltage": voltage, "Counter": number % (self.counts or 256), "Epoch": epoch})

    def decode(self, can_id: int, data: bytes) -> Frame | None:
        """What a frame says, the first thing of several; None where it is not the DAQ's, or is spoilt."""
        with suppress(SpoiltFrameError):
            return next(iter(self.read(can_id, can_id > 0x7FF, data)), None)
        return None

    def read(self, can_id: int, extended: bool, data: bytes) -> list[Frame]:
        """What a frame says; nothing where it is not the DAQ's.

        Raises
        ------
        SpoiltFrameError
            It has an identifier of the DAQ, and is not what the DBC file says.
        """
        parts = self._by_id.get(can_id, ())
        return [frame for part in parts if (frame := self._frame(part, extended, data)) is not None]

    def _frame(self, part: Part, extended: bool, data: bytes) -> Frame | None:
        """A frame as a message here; None where it has none of its signals, which then come at other times."""
        if extended != part.message.is_extended_frame:
            raise SpoiltFrameError(Message("frames with an identifier of another length than the DBC file says"))
        if len(data) != part.message.length:
            raise SpoiltFrameError(Message("frames of another length than the DBC file says"))
        checksum = self._checksums.get(part.name)
        if checksum is not None and not checksum.fits(data):
            raise SpoiltFrameError(Message("frames with a wrong checksum"))
        try:
            decoded = part.message.decode_simple(data)
        except Exception as error:  # cantools raises several kinds, for example for an unknown multiplexer
            raise SpoiltFrameError(Message("frames that the DBC file does not explain")) from error
        found = {name: signal for name, signal in part.signals.items() if signal.name in decoded}
        values = {name: self._ours(part.name, name, decoded[signal.name]) for name, signal in found.items()}
        if any(isinstance(values.get(name), str) for name in _COUNTED):
            raise SpoiltFrameError(Message("frames whose counter is no number"))
        return Frame(name=part.name, signals=values) if values.keys() - _COUNTED else None

    def _ours(self, message: str, name: str, value: float | str | NamedSignalValue) -> Value:
        if isinstance(value, NamedSignalValue):
            return value.name
        return value if isinstance(value, str) else self._units[message, name].to_ours(value)

    def _theirs(self, message: str, name: str, value: Value) -> Value:
        return value if isinstance(value, str) else self._units[message, name].to_theirs(value)


@cache
def _ours() -> Database:
    """The DBC file that comes along, which nobody changes, read once. Raises `OSError`."""
    with as_file(files("tumble.drivers.candaq") / "tumble_daq.dbc") as path:
        return load_dbc(path, strict=True)
