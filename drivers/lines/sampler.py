"""Samples from an instrument that tells them in lines of text."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final, Protocol

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.lines.form import LineForm, Sample, SpoiltLineError
from tumble.drivers.lines.gathered import Gathered
from tumble.drivers.links.tally import Tally
from tumble.drivers.protocols import ChannelBlock, Identity
from tumble.drivers.usable import Watch
from tumble.messages import Message

DEVICE: Final = Message("serial DAQ")
PATIENCE_S: Final = 2.0
"""How much longer than from one line to the next a line may take, in real time."""
_MOST_SPOILT: Final = 20
"""So many lines in a row that say nothing are no passing trouble."""


class Line(Protocol):
    """What is needed of a serial line, see `tumble.drivers.links.serial_link`."""

    def write(self, data: bytes) -> None:
        """Send bytes."""
        ...

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        """Wait for a line."""
        ...

    def discard_input(self) -> None:
        """Throw away what has come so far."""
        ...

    def reopen(self) -> None:
        """Open the line anew."""
        ...


@dataclass(frozen=True, kw_only=True)
class Requests:
    """What an instrument is asked, each ended by a line feed; nothing where it is empty."""

    line: str = ""
    identity: str = ""
    identity_start: str = "ID,"


class LineSampler:
    """Fits `Sampler`, `Reconnectable` and `Remarking`.

    A block is the next lines that come, or that are asked for. Spoilt ones are dropped and counted; a block of which
    one was dropped, or whose counter does not go up by one, is taken once more.

    Parameters
    ----------
    link
        The serial line.
    form
        What its lines look like.
    clock
        Paces requests, and dates a block.
    requests
        What it is asked.
    modulus
        How far its counter counts; 0 where it has none.
    """

    def __init__(self, link: Line, form: LineForm, clock: Clock, requests: Requests, *, modulus: int) -> None:
        self._link, self._form, self._clock, self._requests = link, form, clock, requests
        self._modulus = modulus
        self._tally = Tally(DEVICE)
        self._watch = Watch(DEVICE, {name: each.range for name, each in form.quantities.items()})

    def reconnect(self) -> None:
        """Open the line anew. Raises `LinkLostError` while nobody sends there."""
        self._link.reopen()
        with _silence_as_loss():
            self.identify()

    def remarks(self) -> tuple[str, ...]:
        """What was dropped."""
        return self._tally.remarks()

    def last_remarks(self) -> tuple[str, ...]:
        """What of that has not been told."""
        return self._tally.last_remarks()

    def identify(self) -> Identity:
        """What it says of itself, if it can be asked; at least it must send lines. Raises `DeviceError`."""
        self._begin()
        self._watch.forget()
        told = self._identity() if self._requests.identity else ()
        self._next(PATIENCE_S)
        model, serial, firmware = (*told, "", "", "")[:3]
        return Identity(model=model or Message("instrument that sends lines"), serial=serial, firmware=firmware)

    def acquire(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Take the next samples; where lines are lost, doubled or spoilt, once more.

        NaN is passed on where a line holds no number, 9.9e37 where a value is out of its range.

        Raises
        ------
        DeviceError
            Lines came to harm both times, it sends at another rate, or tells a channel in another unit.
        LinkLostError
            The line is gone, or no more lines come.
        """
        complaint = ""
        for _ in range(2):
            with _silence_as_loss():
                gathered = self._gathered(samples, rate_hz)
            complaint = gathered.complaint(self._modulus)
            if not complaint:
                self._check_rate(gathered, rate_hz)
                block = gathered.block(rate_hz)
                self._watch.see(block.channels, rate_hz)
                return block
        raise DeviceError(
            DEVICE,
            Message("{complaint}, twice in a row", complaint=complaint),
            Message("check cable, baud rate and the columns in the stand file"),
        )

    def _gathered(self, samples: int, rate_hz: float) -> Gathered:
        """So many good lines, and how many were not."""
        self._begin()
        gathered, began_s = Gathered(), self._clock.monotonic_s()
        for number in range(samples):
            if self._requests.line:
                self._clock.sleep(began_s + number / rate_hz - self._clock.monotonic_s())
            sample, spoilt = self._next(1.0 / rate_hz + PATIENCE_S)
            gathered.add(sample, self._clock.monotonic_s(), spoilt)
        return gathered

    def _begin(self) -> None:
        """Take what comes from now on: the rest of a line that is under way is none."""
        self._link.discard_input()
        if not self._requests.line:
            self._read(PATIENCE_S)

    def _next(self, timeout_s: float) -> tuple[Sample, int]:
        """The next good line, and how many were dropped before it. Raises `NoReplyError`, `DeviceError`."""
        for spoilt in range(_MOST_SPOILT):
            if self._requests.line:
                self._ask(self._requests.line)
            line = self._read(timeout_s)
            try:
                return self._form.read(line), spoilt
            except SpoiltLineError as error:
                self._tally.count(Message("{error} dropped", error=error), ascii(line.decode("latin-1").strip()))
        raise DeviceError(
            DEVICE,
            Message.counted(
                "sent {count} line in a row that says nothing ({dropped})",
                "sent {count} lines in a row that say nothing ({dropped})",
                count=_MOST_SPOILT,
                dropped=self._tally.words,
            ),
            Message("check cable, baud rate and the columns in the stand file"),
        )

    def _read(self, timeout_s: float) -> bytes:
        return self._link.read_line(self._form.terminator, timeout_s)

    def _ask(self, request: str) -> None:
        self._link.write(f"{request}\r\n".encode())

    def _identity(self) -> tuple[str, ...]:
        """Model, serial number and firmware; lines of samples before them are passed over."""
        self._ask(self._requests.identity)
        start = self._requests.identity_start
        for _ in range(_MOST_SPOILT):
            text = self._read(PATIENCE_S).decode("ascii", "replace").strip()
            if text.startswith(start):
                return tuple(part.strip() for part in text.removeprefix(start).split(","))
        raise NoReplyError(
            DEVICE,
            Message("does not say who it is"),
            Message("check identity_request and identity_start in the stand file"),
        )

    def _check_rate(self, gathered: Gathered, rate_hz: float) -> None:
        """Make sure that lines that come by themselves do so at the rate of the stand file. Raises `DeviceError`."""
        found_hz = None if self._requests.line else gathered.other_rate_hz(rate_hz)
        if found_hz is not None:
            raise DeviceError(
                DEVICE,
                Message(
                    "sends {found_hz:.3g} lines a second by itself, and {rate_hz:g} were asked for",
                    found_hz=found_hz,
                    rate_hz=rate_hz,
                ),
                Message("write the rate at which it sends as rate_hz into the stand file"),
            )


@contextmanager
def _silence_as_loss() -> Iterator[None]:
    """Tell silence as a lost link: what sends by itself and falls silent has lost its power, and may come back."""
    try:
        yield
    except NoReplyError as error:
        raise LinkLostError(error.device, error.happened, error.remedy) from error
