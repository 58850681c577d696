"""The frames of a DAQ as they come from its bus."""

import time
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, Queue
from typing import Final

import can

from tumble.drivers.candaq.frames import DaqFrames, Frame, SpoiltFrameError
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.links.tally import Tally
from tumble.messages import Message

DEVICE: Final = Message("CAN DAQ")
"""What errors call it."""

MOST_WAITING: Final = 100_000
"""Frames that are kept for whoever asks for them; of more, the oldest are dropped."""

_SLICE_S: Final = 0.05


class Inbox:
    """Takes the frames of a DAQ from a link that others may share; spoilt ones are dropped and counted.

    `check` is called many times a second while one is awaited; what it raises breaks the wait off.
    """

    def __init__(self, link: CanLink, frames: DaqFrames, check: Callable[[], object] = lambda: None) -> None:
        self._link = link
        self._check = check
        self._frames = frames
        self._tally = Tally(DEVICE)
        self._received: Queue[Frame] = Queue()
        link.subscribe(self._hear)

    def next(self, deadline_s: float) -> Frame | None:
        """The next frame; None after the deadline, by the computer's clock. Raises `LinkLostError`."""
        while time.monotonic() <= deadline_s:
            self._check()
            try:
                return self._received.get(timeout=_SLICE_S)
            except Empty:
                self._link.check()
        return None

    def forget(self) -> None:
        """Throw away what has come so far."""
        with suppress(Empty):
            while True:
                self._received.get_nowait()

    def remarks(self) -> tuple[str, ...]:
        """What was dropped here and on the link, as far as it is time to tell of it."""
        return self._tally.remarks() + self._link.tally.remarks()

    def last_remarks(self) -> tuple[str, ...]:
        """What of that has not been told."""
        return self._tally.last_remarks() + self._link.tally.last_remarks()

    @property
    def words(self) -> str:
        """The same within a sentence about frames that did not come; empty where nothing was dropped."""
        counts = [tally.words for tally in (self._tally, self._link.tally) if tally.words]
        return Message(" ({counts})", counts=Message.joined(", ", counts)) if counts else ""

    def _hear(self, message: can.Message) -> None:
        try:
            frames = self._frames.read(message.arbitration_id, message.is_extended_id, bytes(message.data))
        except SpoiltFrameError as error:
            self._tally.count(
                Message("{error} dropped", error=error),
                f"{message.arbitration_id:X}h {message.data.hex()}",
            )
            return
        for frame in frames:
            if self._received.qsize() >= MOST_WAITING:  # nobody measures, and the DAQ sends all the same
                with suppress(Empty):
                    self._received.get_nowait()
            self._received.put(frame)
