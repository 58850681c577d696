"""A line on which somebody sends without pause, on a fake port."""

import itertools

import pytest
import serial

from drivers.clock import VirtualClock
from drivers.errors import NoReplyError
from drivers.links import SerialLink, serial_link
from drivers.scpi import ScpiMultimeter
from drivers.zaber import ZaberHead

SLOW = itertools.count(0.0, 0.05)


class Chatterbox:
    """A port on which something always waits."""

    def __init__(self, piece):
        self.in_waiting = len(piece)
        self.piece = piece
        self.written = []

    def read(self, _size):
        return self.piece

    def write(self, data):
        self.written.append(data)

    def close(self):
        pass


@pytest.fixture
def chatterbox(monkeypatch):
    """Makes such a port, and a link to it."""

    def make(piece):
        port = Chatterbox(piece)
        monkeypatch.setattr(serial, "serial_for_url", lambda *_, **__: port)
        return port, SerialLink("COM7", device="stage")

    return make


def head_on(link):
    return ZaberHead(link, steps_per_deg=1000.0, limits_deg=(0.0, 90.0), speed_deg_s=20.0, clock=VirtualClock())


def test_a_flood_of_bytes_is_no_longer_thrown_away_after_some_megabytes(chatterbox):
    _, link = chatterbox(b"x" * 65536)
    with pytest.raises(NoReplyError, match="stage: sends without pause at COM7, unasked; check the baud rate"):
        link.discard_input()


def test_a_trickle_that_does_not_end_is_thrown_away_for_a_second(chatterbox, monkeypatch):
    monkeypatch.setattr(serial_link.time, "monotonic", lambda: next(SLOW))
    _, link = chatterbox(b"x")
    before_s = next(SLOW)
    with pytest.raises(NoReplyError, match="without pause"):
        link.discard_input()
    assert 1.0 <= next(SLOW) - before_s < 1.3


def test_noise_without_the_end_of_a_line_is_no_answer(chatterbox):
    _, link = chatterbox(b"x" * 65536)
    with pytest.raises(NoReplyError, match="sent 1048576 bytes at COM7 without the end of a line"):
        link.read_line(b"\n", 1e9)


def test_a_head_on_such_a_line_is_told_to_stop_all_the_same(chatterbox):
    port, link = chatterbox(b"x" * 65536)
    with pytest.raises(NoReplyError, match="without pause"):
        head_on(link).stop()
    (told,) = port.written
    assert told.startswith(b"/1 1 01 stop:")


def test_a_multimeter_on_such_a_line_gives_no_answer(chatterbox):
    _, link = chatterbox(b"1.0\n" * 65536)
    with pytest.raises(NoReplyError, match="without pause"):
        ScpiMultimeter(link, VirtualClock()).identify()


def test_messages_of_others_without_end_are_no_answer(monkeypatch):
    class Alerts:
        """Falls silent before a request, and sends nothing but alerts after it."""

        discard_input = staticmethod(lambda: None)
        write = staticmethod(lambda _: None)
        read_line = staticmethod(lambda _terminator, _timeout_s: b"!01 1 IDLE --\r\n")

    moments = itertools.count(0.0, 0.01)
    monkeypatch.setattr(serial_link.time, "monotonic", lambda: next(moments))
    with pytest.raises(NoReplyError, match=r"did not come within 0.6 s"):
        head_on(Alerts()).status()
