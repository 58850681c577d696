"""A voltmeter on CAN that streams its samples frame by frame."""

import math
import time
from collections.abc import Callable
from typing import Final

import numpy as np

from tumble.drivers.candaq.collection import Collection
from tumble.drivers.candaq.frames import DaqFrames, Frame
from tumble.drivers.candaq.inbox import DEVICE, Inbox
from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.protocols import Identity, SampleBlock
from tumble.messages import Message

TRIES: Final = 3
REPLY_TIMEOUT_S: Final = 0.5
LATENESS_S: Final = 2.0
"""How much longer than its samples an acquisition may take."""
MOST_SAMPLES: Final = (1 << 24) - 1


class CanDaq:
    """A DAQ whose frames a DBC file describes. Fits `Sampler`, `Reconnectable` and `Remarking`.

    Parameters
    ----------
    link
        The bus; others may share it.
    frames
        The DAQ's frames.
    clock
        Dates a block where the DAQ does not tell its own time.
    check
        Called many times a second while a frame is awaited; what it raises breaks the wait off.

    Raises
    ------
    LinkLostError
        The bus is not there.
    """

    def __init__(
        self, link: CanLink, frames: DaqFrames, clock: Clock, check: Callable[[], object] = lambda: None
    ) -> None:
        self._link = link
        self._frames = frames
        self._clock = clock
        self._generation = 0
        self._epoch = 0
        self._inbox = Inbox(link, frames, check)
        self._generation = link.reopen(self._generation)

    def reconnect(self) -> None:
        """Open the bus anew, unless another instrument on it has. Raises `LinkLostError` while nobody answers there."""
        self._generation = self._link.reopen(self._generation)
        try:
            self.identify()
        except NoReplyError as error:
            raise LinkLostError(error.device, error.happened, error.remedy) from error

    def remarks(self) -> tuple[str, ...]:
        """What was dropped or tried again."""
        return self._inbox.remarks()

    def last_remarks(self) -> tuple[str, ...]:
        """What of that has not been told."""
        return self._inbox.last_remarks()

    def identify(self) -> Identity:
        """Product, serial number and firmware. Raises `LinkLostError`, `NoReplyError`."""
        signals = self._ask(0, 0.0, "Identity").signals
        return Identity(
            model=str(signals["Product"]), serial=f"{signals['Serial']:.0f}", firmware=f"{signals['Firmware']:.0f}"
        )

    def acquire(self, samples: int, rate_hz: float) -> SampleBlock:
        """Take samples from now on; where frames are lost or doubled, once more.

        NaN and 9.9e37, for an overload, are passed on as they are.

        Raises
        ------
        DeviceError
            Frames were lost or doubled both times, or so many samples cannot be taken.
        NoReplyError
            The DAQ does not start.
        LinkLostError
            The bus is gone.
        """
        if not (1 <= samples <= MOST_SAMPLES and 0.0 < rate_hz < math.inf):
            raise DeviceError(
                DEVICE,
                Message("{samples} samples at {rate_hz:g} Hz cannot be taken", samples=samples, rate_hz=rate_hz),
                Message("ask for 1 to {most} samples at a positive rate", most=MOST_SAMPLES),
            )
        complaint = ""
        for _ in range(2):
            began_s = self._clock.monotonic_s()
            collection = self._stream(samples, rate_hz)
            complaint = self._complaint(collection, samples)
            if not complaint:
                return SampleBlock(
                    voltage_v=np.array(collection.voltages_v),
                    rate_hz=rate_hz,
                    device_time_s=began_s if collection.started_s is None else collection.started_s,
                    temperature_degc=collection.temperature_degc,
                )
            self._send(0, 0.0)
        happened = Message("{complaint}, twice in a row{dropped}", complaint=complaint, dropped=self._inbox.words)
        raise DeviceError(DEVICE, happened, Message("check the load of the bus, cable and termination"))

    def _complaint(self, collection: Collection, samples: int) -> str:
        """What is wrong with a block; empty where it is whole."""
        if collection.missing or collection.doubled:
            return Message.counted(
                "{missing} of {count} voltage frame was lost and {doubled} came twice",
                "{missing} of {count} voltage frames were lost and {doubled} came twice",
                missing=collection.missing,
                count=samples,
                doubled=collection.doubled,
            )
        if self._frames.has("Temperature") and collection.temperature_degc is None:
            return Message("every temperature frame was lost")
        return ""

    def _stream(self, samples: int, rate_hz: float) -> Collection:
        """Start an acquisition and collect its frames until the last one, or until it is late."""
        self._ask(samples, rate_hz, "Started")
        collection = Collection(samples, self._epoch)
        deadline_s = time.monotonic() + samples / rate_hz + LATENESS_S
        while not collection.ended and (frame := self._inbox.next(deadline_s)):
            collection.take(frame)
        return collection

    def _ask(self, samples: int, rate_hz: float, answer: str) -> Frame:
        """Send a command until it is answered; each time it gets an epoch of its own."""
        for _ in range(TRIES):
            self._inbox.forget()
            self._send(samples, rate_hz)
            deadline_s = time.monotonic() + REPLY_TIMEOUT_S
            while frame := self._inbox.next(deadline_s):
                if frame.name == answer and self._repeats(frame, samples, rate_hz):
                    return frame
        raise NoReplyError(
            DEVICE,
            Message("gave no answer in {tries} tries{dropped}", tries=TRIES, dropped=self._inbox.words),
            Message("check its power and the DBC file, then resume"),
        )

    def _repeats(self, frame: Frame, samples: int, rate_hz: float) -> bool:
        """Whether the DAQ has understood the command as it was meant; other answers have nothing to repeat."""
        told = (self._epoch, samples, float(np.float32(rate_hz)))
        return frame.name != "Started" or tuple(frame.number(s) for s in ("Epoch", "Samples", "Rate")) == told

    def _send(self, samples: int, rate_hz: float) -> None:
        self._epoch = (self._epoch + 1) % 256
        can_id, data = self._frames.encode("Command", {"Epoch": self._epoch, "Samples": samples, "Rate": rate_hz})
        self._link.send(can_id, data)
