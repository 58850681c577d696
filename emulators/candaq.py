"""An emulated CAN DAQ, which reads the simulated unit and streams frame by frame."""

import threading
import time
from collections.abc import Iterator
from typing import Final

import can

from tumble.drivers.candaq import DaqFrames
from tumble.drivers.candaq.frames import Value
from tumble.drivers.links.can_link import BUS_OFF
from tumble.drivers.protocols import Block
from tumble.emulators.candaq_faults import spoilt
from tumble.emulators.faults import WIRE, Faults
from tumble.emulators.foreign_frames import foreign_frames
from tumble.emulators.world import SharedWorld

SERIAL: Final = 310001
PRODUCT: Final = 1
FIRMWARE: Final = 1

TEMPERATURE_EVERY: Final = 16
"""Number of voltage frames for one of temperature."""

_IDLE_S: Final = 0.02
_NAP_S: Final = 0.02
"""Longest wait of the world's clock between two looks at the bus."""

Entry = tuple[float, int, bytes]
"""When a frame is due by the world's clock, its identifier, and its bytes."""


class EmulatedCanDaq:
    """A DAQ on a python-can `virtual` channel, with a thread of its own until it is closed.

    Parameters
    ----------
    world
        The simulated stand.
    channel
        Name of the virtual channel.
    faults
        What goes wrong; nothing by default. Its commands read `acquire SAMPLES RATE`.
    frames
        The frames that it speaks; by default those of the DBC file that comes along.
    """

    def __init__(
        self, world: SharedWorld, channel: str, faults: Faults | None = None, frames: DaqFrames | None = None
    ) -> None:
        self._world = world
        self._faults = faults or Faults()
        self._frames = frames or DaqFrames.from_file()
        self._serial = SERIAL
        self._bus = can.Bus(interface="virtual", channel=channel)
        self._stream: Iterator[Entry] = iter(())
        self._next: Entry | None = None
        self._silent_until_s = 0.0
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._live, name="CAN DAQ", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Switch it off; returns when its thread has ended."""
        self._closing.set()
        self._thread.join()
        self._bus.shutdown()

    def _live(self) -> None:
        while not self._closing.is_set():
            message = self._bus.recv(0.0 if self._next else _IDLE_S)
            self._suffer()
            if time.monotonic() < self._silent_until_s:
                continue
            if message is not None and not message.is_error_frame:
                self._hear(message)
            self._send_due()

    def _suffer(self) -> None:
        """Have the fault happen that is due, if any."""
        fault = self._faults.take("power_loss", "bus_off", "swapped", "foreign_frames")
        if fault is None:
            return
        if fault.kind == "swapped":
            self._serial += 1
            return
        if fault.kind == "foreign_frames":
            voltage_id, _ = self._frames.encode_voltage(0.0, 0, 0)
            for message in foreign_frames(voltage_id):
                self._bus.send(message)
            return
        if fault.kind == "bus_off":
            self._bus.send(can.Message(arbitration_id=BUS_OFF, is_error_frame=True, is_extended_id=True))
        self._silent_until_s = time.monotonic() + fault.lasts_s
        self._next = None

    def _hear(self, message: can.Message) -> None:
        frame = self._frames.decode(message.arbitration_id, bytes(message.data))
        if frame is None or frame.name != "Command":
            return
        epoch, samples, rate_hz = (frame.number(name) for name in ("Epoch", "Samples", "Rate"))
        if samples and rate_hz > 0.0:
            self._faults.note_command(f"acquire {samples:.0f} {rate_hz:g}".encode())
            self._start(int(epoch), int(samples), rate_hz)
        else:
            self._next = None
            self._send("Identity", {"Serial": self._serial, "Product": PRODUCT, "Firmware": FIRMWARE})

    def _start(self, epoch: int, samples: int, rate_hz: float) -> None:
        with self._world.lock:
            block = self._world.daq.take(samples, rate_hz)
        self._stream = self._entries(block, epoch)
        fault = self._faults.take("frames_lost", "nan", "overload", *WIRE)
        if fault is not None:
            self._stream = spoilt(self._stream, fault, self._frames, epoch, samples // 2)
        self._send("Started", {"Epoch": epoch, "Samples": samples, "Rate": rate_hz})
        self._next = next(self._stream, None)

    def _entries(self, block: Block, epoch: int) -> Iterator[Entry]:
        """The frames of a block in their order."""
        started_s = block.device_time_s
        (voltage_v,) = block.channels.values()
        if self._frames.has("Time"):
            yield started_s, *self._frames.encode("Time", {"Time": started_s, "Epoch": epoch})
        for i, sample_v in enumerate(voltage_v.tolist()):
            due_s = started_s + (i + 1) / block.rate_hz
            if i % TEMPERATURE_EVERY == 0 and self._frames.has("Temperature"):
                told: dict[str, Value] = {"Temperature": block.temperature_degc or 0.0, "Epoch": epoch}
                yield due_s, *self._frames.encode("Temperature", told | {"Counter": i // TEMPERATURE_EVERY % 256})
            yield due_s, *self._frames.encode_voltage(sample_v, i, epoch)

    def _send_due(self) -> None:
        """Send what is due; where nothing is, wait a little, so that also a virtual clock goes on."""
        if self._next is None:
            return
        with self._world.lock:
            wait_s = self._next[0] - self._world.clock.monotonic_s()
            self._world.clock.sleep(min(wait_s, _NAP_S))
        if wait_s <= _NAP_S:
            _, can_id, data = self._next
            self._transmit(can_id, data)
            self._next = next(self._stream, None)

    def _send(self, name: str, signals: dict[str, Value]) -> None:
        self._transmit(*self._frames.encode(name, signals))

    def _transmit(self, can_id: int, data: bytes) -> None:
        self._bus.send(can.Message(arbitration_id=can_id, data=data, is_extended_id=can_id > 0x7FF))
