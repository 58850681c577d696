"""An emulated CAN DAQ that sends several channels by itself."""

import math
import threading
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import can
from cantools.database.can import Message as DbcMessage

from tumble.drivers.candaq.checksum import Checksum
from tumble.drivers.candaq.declaration import CanDaqTable, database_of
from tumble.drivers.candaq.units import unit_of
from tumble.drivers.links.can_link import BUS_OFF
from tumble.drivers.quantities import Unit
from tumble.emulators.faults import Fault, Faults
from tumble.emulators.foreign_frames import foreign_frames
from tumble.emulators.lines import SMALLER_UNIT
from tumble.emulators.pace import Pace
from tumble.emulators.world import SharedWorld

SERIAL: Final = 310002
IDENTITY_S: Final = 0.5
"""From one frame that says who it is to the next, by the clock of the world."""
_LOOK_S: Final = 0.002
_FAULTS: Final = ("nan", "overload", "frames_lost", "stale", "other_unit", "garble", "cut", "wrong_checksum", "double")


@dataclass(frozen=True, kw_only=True)
class Sent:
    """A message of the DBC file that it sends."""

    message: DbcMessage
    signals: Mapping[str, tuple[str, Unit]]
    """Channel and unit by signal."""
    thermometers: Mapping[str, Unit]
    counter: str
    checksum: Checksum | None

    def frame(self, values: Mapping[str, float], degc: float, count: int) -> bytes:
        """The frame that says this; what a signal cannot hold goes as `Overload`, NaN as `Invalid`."""
        told: dict[str, float | str] = {signal.name: 0.0 for signal in self.message.signals}
        for name, (channel, unit) in self.signals.items():
            told[name] = self._held(name, unit.to_theirs(values[channel]))
        told |= {name: unit.to_theirs(degc) for name, unit in self.thermometers.items()}
        if self.counter:
            told[self.counter] = count % (1 << self.message.get_signal_by_name(self.counter).length)
        data = self.message.encode(told, strict=False)
        return self.checksum.put_into(data) if self.checksum else data

    def _held(self, name: str, value: float) -> float | str:
        if math.isnan(value):
            return "Invalid"
        signal = self.message.get_signal_by_name(name)
        most = (1 << (signal.length - 1)) - 2
        return value if abs(signal.conversion.numeric_scaled_to_raw(value)) <= most else "Overload"


def sent_by(table: CanDaqTable, folder: Path) -> list[Sent]:
    """What a DAQ of a stand file sends. Raises `ValueError`."""
    database = database_of(table, folder)
    found = []
    for message in database.messages:
        named = {each.name: each for each in message.signals}
        channels = _in_message(table.channel_signals, message.name)
        thermometers = _in_message(table.temperatures, message.name)
        if not channels and not thermometers:
            continue
        found.append(
            Sent(
                message=message,
                signals={
                    name: (channel, unit_of("Voltage", named[name], channel)) for name, channel in channels.items()
                },
                thermometers={name: unit_of("Temperature", named[name]) for name in thermometers},
                counter=table.counter if table.counter in named else "",
                checksum=Checksum(message, named[table.checksum]) if table.checksum in named else None,
            )
        )
    return found


def _in_message(places: Mapping[str, str], message: str) -> dict[str, str]:
    """Channels by signal, of the signals in a message."""
    parts = {channel: place.rpartition(".")[::2] for channel, place in places.items()}
    return {signal: channel for channel, (name, signal) in parts.items() if name == message}


class EmulatedFreeCanDaq:
    """A DAQ on a python-can `virtual` channel, with a thread of its own until it is closed.

    Parameters
    ----------
    world
        Where it is wired.
    channel
        Name of the virtual channel.
    faults
        What goes wrong, a sample at a time.
    table
        Its table in the stand file.
    folder
        Where the path of the DBC file begins. Raises `ValueError` where that cannot be used.
    """

    def __init__(self, world: SharedWorld, channel: str, faults: Faults, table: CanDaqTable, folder: Path) -> None:
        self._world, self._faults, self._table = world, faults, table
        self._sent = sent_by(table, folder)
        self._identity = self._identity_of(folder)
        self._serial = SERIAL
        self._pace, self._identity_pace = (Pace(world.clock, hz) for hz in (table.rate_hz, 1.0 / IDENTITY_S))
        self._count = -1
        self._silent_until_s = 0.0
        self._bus = can.Bus(interface="virtual", channel=channel)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._live, name="free CAN DAQ", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Switch it off; returns when its thread has ended."""
        self._closing.set()
        self._thread.join()
        self._bus.shutdown()

    def _live(self) -> None:
        while not self._closing.wait(_LOOK_S):
            self._suffer()
            for number in range(self._identity_pace.due()):
                if self._identity and not number:
                    self._transmit(self._identity, self._identity.encode(self._who(), strict=False))
            if samples := self._pace.due():
                self._sample(samples)

    def _suffer(self) -> None:
        fault = self._faults.take("power_loss", "bus_off", "swapped", "foreign_frames")
        if fault is None:
            return
        if fault.kind == "swapped":
            self._serial += 1
        elif fault.kind == "foreign_frames":
            for message in foreign_frames(self._sent[0].message.frame_id):
                self._bus.send(message)
        else:
            if fault.kind == "bus_off":
                self._bus.send(can.Message(arbitration_id=BUS_OFF, is_error_frame=True, is_extended_id=True))
            self._silent_until_s = time.monotonic() + fault.lasts_s

    def _sample(self, samples: int) -> None:
        with self._world.lock:
            block = self._world.daq.take(samples, self._table.rate_hz)
        for row in range(samples):
            values = {name: float(each[row]) for name, each in block.channels.items()}
            fault = self._faults.take(*_FAULTS)
            for sent, data in self._frames(values, block.temperature_degc or 0.0, fault):
                self._transmit(sent.message, data)

    def _frames(self, values: dict[str, float], degc: float, fault: Fault | None) -> Iterator[tuple[Sent, bytes]]:
        """The frames of a sample."""
        kind = fault.kind if fault else ""
        self._count += kind != "stale"
        told = {
            "nan": dict.fromkeys(values, float("nan")),
            "overload": dict.fromkeys(values, float("inf")),
            "other_unit": {name: value * SMALLER_UNIT for name, value in values.items()},
        }.get(kind, values)
        for sent in self._sent:
            data = sent.frame(told, degc, self._count)
            if kind in ("garble", "wrong_checksum"):
                data = bytes([data[0] ^ 0x10]) + data[1:]
            if kind == "cut":
                data = data[: len(data) // 2]
            for _ in range({"frames_lost": 0, "double": 2}.get(kind, 1)):
                yield sent, data

    def _identity_of(self, folder: Path) -> DbcMessage | None:
        places = list(self._table.identity.values())
        return database_of(self._table, folder).get_message_by_name(places[0].rpartition(".")[0]) if places else None

    def _who(self) -> dict[str, float]:
        assert self._identity
        told = {signal.name: 0.0 for signal in self._identity.signals}
        known = {"Serial": self._serial, "Product": 1, "Firmware": 1}
        return told | {place.rpartition(".")[2]: known.get(name, 0) for name, place in self._table.identity.items()}

    def _transmit(self, message: DbcMessage, data: bytes) -> None:
        if time.monotonic() >= self._silent_until_s:
            self._bus.send(
                can.Message(arbitration_id=message.frame_id, data=data, is_extended_id=message.frame_id > 0x7FF)
            )
