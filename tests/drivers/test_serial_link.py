"""A line on which somebody sends without pause, on a fake port."""

import errno
import itertools
import socket

import pytest
import serial

from tumble.drivers.attention import Attention
from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import LinkLostError, NoReplyError
from tumble.drivers.links import SerialLink, serial_link
from tumble.drivers.scpi import ScpiMultimeter
from tumble.drivers.zaber import ZaberHead

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


class Halves:
    """A port that gives a line in two pieces, the second when that is wanted."""

    in_waiting = 0

    def __init__(self):
        self.pieces = [b"+2.5", b""]

    def read(self, _size):
        return self.pieces.pop(0) if self.pieces else b""


def test_a_wait_is_broken_off_where_that_is_wanted_and_what_came_stays(monkeypatch):
    port = Halves()
    monkeypatch.setattr(serial, "serial_for_url", lambda *_, **__: port)
    attention = Attention()
    link = SerialLink("COM7", check=attention.check)

    def stop():
        if not port.pieces:
            raise KeyboardInterrupt

    with attention.paid_to(stop), pytest.raises(KeyboardInterrupt):
        link.read_line(b"\n", 1e9)
    port.pieces = [b"1\n"]
    assert link.read_line(b"\n", 1e9) == b"+2.51\n"


class TerminalError(Exception):
    """As `termios.error`, which there is none of on Windows."""


TerminalError.__module__ = "termios"
FLAPS = TerminalError(5, "Input/output error")


class Flapping:
    """A port on which every call fails some times, then answers `ok`."""

    def __init__(self, error, times):
        self.error, self.left = error, dict.fromkeys(("read", "write", "in_waiting"), times)
        self.written, self.given = b"", [b"o", b"k\n"]

    def _fail(self, name):
        if self.left[name]:
            self.left[name] -= 1
            raise self.error

    @property
    def in_waiting(self):
        self._fail("in_waiting")
        return len(self.given[0]) if self.given else 0

    def read(self, _size):
        self._fail("read")
        return self.given.pop(0) if self.given else b""

    def write(self, data):
        self._fail("write")
        self.written += data

    def close(self):
        raise FLAPS


@pytest.mark.parametrize("error", [FLAPS, OSError(errno.EINTR, "interrupted"), BlockingIOError(errno.EAGAIN, "again")])
def test_a_port_that_fails_for_a_moment_is_tried_again(monkeypatch, error):
    port = Flapping(error, times=3)
    monkeypatch.setattr(serial, "serial_for_url", lambda *_, **__: port)
    link = SerialLink("COM7")
    link.write(b"say\n")
    assert link.read_line(b"\n", 5.0) == b"ok\n"
    assert port.written == b"say\n"
    link.close()


@pytest.mark.parametrize("error", [FLAPS, ValueError("not in a port's range"), TypeError("odd"), IndexError("cut")])
@pytest.mark.parametrize(
    "use", [lambda link: link.write(b"x"), lambda link: link.read_line(b"\n", 9.0), SerialLink.discard_input]
)
def test_whatever_a_port_raises_is_a_lost_link_with_its_reason(monkeypatch, error, use):
    for name in ("FAILING_S", "WRITE_TIMEOUT_S"):
        monkeypatch.setattr(serial_link, name, 0.02)
    monkeypatch.setattr(serial, "serial_for_url", lambda *_, **__: Flapping(error, times=10**9))
    with pytest.raises(LinkLostError, match=rf"the link at COM7 is lost .{type(error).__name__}: "):
        use(SerialLink("COM7"))


@pytest.mark.parametrize(("times", "opened"), [(2, True), (10**9, False)])
def test_a_port_that_flaps_when_it_is_opened_is_tried_again_for_a_while(monkeypatch, times, opened):
    monkeypatch.setattr(serial_link, "FAILING_S", 0.05)
    failures = itertools.repeat(FLAPS, times)

    def serial_for_url(*_, **__):
        if error := next(failures, None):
            raise error
        return Chatterbox(b"")

    monkeypatch.setattr(serial, "serial_for_url", serial_for_url)
    if opened:
        SerialLink("COM7")
    else:
        with pytest.raises(LinkLostError, match=r"cannot be reached at COM7 .TerminalError: "):
            SerialLink("COM7")


def test_a_port_that_another_program_has_is_told_at_once(monkeypatch):
    tries = []

    def serial_for_url(*_, **__):
        tries.append(True)
        raise serial.SerialException(errno.EAGAIN, "Could not exclusively lock port")

    monkeypatch.setattr(serial, "serial_for_url", serial_for_url)
    with pytest.raises(LinkLostError, match="exclusively lock"):
        SerialLink("COM7")
    assert len(tries) == 1


def test_a_server_has_time_to_notice_that_a_client_has_gone_before_it_comes_again_and_only_then(monkeypatch):
    naps = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        link = SerialLink(f"socket://127.0.0.1:{server.getsockname()[1]}")
        monkeypatch.setattr(serial_link, "RECONNECT_S", 100.0)
        monkeypatch.setattr(serial_link.time, "sleep", naps.append)
        link.close()
        assert naps == []

        link.reopen()
        link.close()

    (nap_s,) = naps
    assert 0.0 < nap_s <= 100.0
