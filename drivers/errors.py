"""What can go wrong at an instrument, and what is no fault of it."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from tumble.messages import Message

NO_ANSWER: Final = Message("does not answer")
CHECK_CABLE: Final = Message("check its cable, then resume the run")
"""What a driver of one's own may say too: the catalogues hold both."""


class DeviceError(Exception):
    """An instrument failed or answered nonsense.

    The message is one sentence for the operator: which device, what happened, what to do.
    """

    instrument: str = ""
    """The name that the stand file gives it; empty until whoever used it says so, and where it is none alone."""

    def __init__(self, device: str, happened: str, remedy: str) -> None:
        super().__init__(device, happened, remedy)
        self.device = device
        self.happened = happened
        self.remedy = remedy

    def __str__(self) -> str:
        return Message("{device}: {happened}; {remedy}", device=self.device, happened=self.happened, remedy=self.remedy)

    def name(self, instrument: str, title: str) -> None:
        """Say which instrument of the stand it is, and what sentences call that; who has said so first is right.

        Where nothing but its name tells it from others of its kind, the message has that, too.
        """
        if self.instrument:
            return
        self.instrument = instrument
        if instrument == title != self.device:
            self.device = Message("{instrument} ({device})", instrument=instrument, device=self.device)

    def saying(self, happened: str, remedy: str) -> "DeviceError":
        """An error of the same instrument that says something else."""
        error = DeviceError(self.device, happened, remedy)
        error.instrument = self.instrument
        return error


@contextmanager
def naming(instrument: str, title: str) -> Iterator[None]:
    """Have a `DeviceError` name the instrument of the stand that is used, which sentences call `title`."""
    try:
        yield
    except DeviceError as error:
        error.name(instrument, title)
        raise


class LimitError(DeviceError):
    """A move was asked for that the head's soft limits forbid; nothing moved."""


class ReferenceLostError(DeviceError):
    """The head no longer knows its angle, and did not move; it has to be homed."""


class LinkLostError(DeviceError):
    """The way to the instrument is gone: port vanished, cable pulled, connection closed.

    What the instrument does meanwhile is unknown; after a reconnect it must be identified and asked.
    """


class NoReplyError(DeviceError):
    """The link stands, but no answer came in time."""


class Interrupted(KeyboardInterrupt):  # named as what it is a kind of
    """The program was told to stop, by the signal that it names: nothing that a driver or its file did."""


def is_of_the_user(error: BaseException) -> bool:
    """Whether an exception comes from whoever runs the program, and not from the code in which it was raised.

    Where nothing turns signals into `Interrupted`, as in a Python session, Ctrl+C is a plain `KeyboardInterrupt` in the
    main thread. Anywhere else such a one was raised by the code.
    """
    if isinstance(error, Interrupted):
        return True
    plain = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    return isinstance(error, KeyboardInterrupt) and plain and threading.current_thread() is threading.main_thread()
