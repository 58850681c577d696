"""A run that its shell put into the background is heard again once it is in the foreground."""

import errno
import io
import os
import sys
import time

import pytest

from tumble.procedures.typed import Typed

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no background")


class Terminal(io.StringIO):
    """Refuses to be read the first time, as a terminal does whose foreground is another's."""

    def __init__(self, descriptor):
        super().__init__("edge\n")
        self.refusals = [OSError(errno.EIO, "Input/output error")]
        self.descriptor = descriptor

    def isatty(self):
        return True

    def fileno(self):
        return self.descriptor

    def __next__(self):
        if self.refusals:
            raise self.refusals.pop()
        return super().__next__()


@pytest.fixture
def ends():
    """Both ends of a terminal: where somebody sits, and where programs read."""
    there, here = os.openpty()
    yield there, here
    os.close(here)


def first_of(typed):
    typed.begin()
    deadline_s = time.monotonic() + 10.0
    while (line := typed.next()) is None and not typed.at_end:
        assert time.monotonic() < deadline_s
        time.sleep(0.01)
    return line


def test_a_terminal_that_refuses_for_now_is_read_on(ends):
    there, here = ends
    assert first_of(Typed(Terminal(here))) == "edge\n"
    os.close(there)


def test_one_that_hung_up_is_not(ends):
    there, here = ends
    os.close(there)
    typed = Typed(Terminal(here))
    assert (first_of(typed), typed.trouble) == (None, "OSError: [Errno 5] Input/output error")


def test_it_is_read_on_after_an_end_of_the_input_that_was_typed(ends):
    there, here = ends
    with os.fdopen(os.dup(here)) as terminal:
        typed = Typed(terminal)
        os.write(there, b"\x04")  # Ctrl+D
        assert (first_of(typed), typed.at_end) == (None, True)
        typed.forget()
        os.write(there, b"stop\n")
        assert first_of(typed) == "stop\n"
        os.close(there)
        assert first_of(typed) is None
