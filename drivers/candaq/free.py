"""A voltmeter on CAN that sends by itself, without being told to begin."""

import time
from collections.abc import Callable
from typing import Final

import numpy as np

from tumble.drivers.candaq.daq import LATENESS_S
from tumble.drivers.candaq.frames import DaqFrames, Frame
from tumble.drivers.candaq.inbox import DEVICE, Inbox
from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.protocols import Identity, SampleBlock
from tumble.messages import Message

FIRST_FRAME_S: Final = 2.0
"""How long the first frame may be waited for, in real time."""
_RATE_RATIO: Final = 1.25
_RATE_S: Final = 0.5
"""A block that takes another time than it should by that ratio, and by so many seconds, has another rate."""


class FreeRunningDaq:
    """A DAQ whose DBC file has no commands. Fits `Sampler`, `Reconnectable` and `Remarking`.

    A block is the next frames that come. Lost and doubled ones are seen where the DBC file has a counter; else a lost
    frame only makes the block longer.

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
        self._inbox = Inbox(link, frames, check)
        self._generation = link.reopen(0)

    def reconnect(self) -> None:
        """Open the bus anew, unless another instrument on it has. Raises `LinkLostError` while nobody sends there."""
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
        """What the DBC file lets it say of itself; at least it must send voltages. Raises `NoReplyError`."""
        self._inbox.forget()
        wanted = "Identity" if self._frames.has("Identity") else "Voltage"
        frame = self._await(wanted, time.monotonic() + FIRST_FRAME_S)
        told = {name: frame.signals.get(name, "") for name in ("Product", "Serial", "Firmware")}
        model, serial, firmware = (
            f"{value:.0f}" if isinstance(value, float | int) else value for value in told.values()
        )
        return Identity(model=model or f"CAN DAQ {self._frames.place_of('Voltage')}", serial=serial, firmware=firmware)

    def acquire(self, samples: int, rate_hz: float) -> SampleBlock:
        """Take the next samples; where frames are lost or doubled, once more.

        Raises
        ------
        DeviceError
            Frames were lost or doubled both times, or it sends at another rate.
        NoReplyError
            Frames do not come.
        LinkLostError
            The bus is gone.
        """
        complaint = ""
        for _ in range(2):
            self.begin()
            block, complaint = self.collected(samples, rate_hz)
            if not complaint:
                return block
        raise twice_in_a_row(complaint)

    def begin(self) -> None:
        """Take what comes from now on."""
        self._inbox.forget()

    def collected(self, samples: int, rate_hz: float, *, dated: bool = True) -> tuple[SampleBlock, str]:
        """The block that has begun, and what is wrong with it; empty where it is whole.

        Where its frames have waited for those of another channel (not `dated`) they tell nothing of their rate. Raises
        as `acquire`.
        """
        deadline_s = time.monotonic() + samples / rate_hz * _RATE_RATIO + FIRST_FRAME_S + LATENESS_S
        voltages_v: list[float] = []
        counters: list[float] = []
        others: dict[str, list[float]] = {"Temperature": [], "Time": []}
        moments_s: list[float] = []
        while len(voltages_v) < samples:
            frame = self._next(
                deadline_s,
                Message.counted(
                    "sent {given} of {count} voltage",
                    "sent {given} of {count} voltages",
                    given=len(voltages_v),
                    count=samples,
                ),
            )
            if frame.name == "Voltage":
                voltages_v.append(frame.number("Voltage"))
                counters.append(frame.number("Counter"))
                moments_s.append(self._clock.monotonic_s())
            elif frame.name in others:
                others[frame.name].append(frame.number(frame.name))
        if dated:
            self._check_rate(moments_s, rate_hz)
        block = SampleBlock(
            voltage_v=np.array(voltages_v),
            rate_hz=rate_hz,
            device_time_s=others["Time"][0] if others["Time"] else moments_s[0],
            temperature_degc=float(np.mean(others["Temperature"])) if others["Temperature"] else None,
        )
        return block, self._complaint(counters)

    def _complaint(self, counters: list[float]) -> str:
        if not self._frames.counts:
            return ""
        steps = np.diff(counters) % self._frames.counts
        wrong = int(np.count_nonzero(steps != 1))
        if not wrong:
            return ""
        return Message.counted(
            "{wrong} of {count} voltage frame did not follow the one before",
            "{wrong} of {count} voltage frames did not follow the one before",
            wrong=wrong,
            count=len(counters),
        )

    def _check_rate(self, moments_s: list[float], rate_hz: float) -> None:
        """Make sure that the frames came at the rate that the stand file says. Raises `DeviceError`."""
        steps = len(moments_s) - 1
        taken_s, planned_s = moments_s[-1] - moments_s[0], steps / rate_hz
        ratio = max(taken_s, planned_s) / max(min(taken_s, planned_s), 1e-9)
        if ratio > _RATE_RATIO and abs(taken_s - planned_s) > _RATE_S:
            happened = Message(
                "sends {found_hz:.3g} samples a second by itself, and {rate_hz:g} were asked for",
                found_hz=steps / max(taken_s, 1e-09),
                rate_hz=rate_hz,
            )
            raise DeviceError(
                DEVICE, happened, Message("write the rate at which it sends as rate_hz into the stand file")
            )

    def _await(self, name: str, deadline_s: float) -> Frame:
        happened = Message(
            "sent no {frame} within {patience_s:g} s",
            frame=self._frames.place_of(name),
            patience_s=FIRST_FRAME_S,
        )
        while (frame := self._next(deadline_s, happened)).name != name:
            pass
        return frame

    def _next(self, deadline_s: float, happened: str) -> Frame:
        """The next frame. Raises `NoReplyError`, which says what `happened`, after the deadline."""
        frame = self._inbox.next(deadline_s)
        if frame is None:
            remedy = Message("check its power, and whether the DBC file is its own")
            raise NoReplyError(
                DEVICE, Message("{happened}{dropped}", happened=happened, dropped=self._inbox.words), remedy
            )
        return frame


def twice_in_a_row(complaint: str) -> DeviceError:
    """The error of a block that came to harm both times."""
    return DeviceError(
        DEVICE,
        Message("{complaint}, twice in a row", complaint=complaint),
        Message("check the load of the bus, cable and termination"),
    )
