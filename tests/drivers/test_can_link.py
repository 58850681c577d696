"""A CAN link over buses that fail, stumble and garble: whatever comes, it is dropped and told, or the link says why."""

import errno
import time
from contextlib import contextmanager, suppress

import can
import pytest

from tumble.drivers.errors import LinkLostError
from tumble.drivers.links import can_link
from tumble.drivers.links.can_address import CanAddress
from tumble.drivers.links.can_link import CanLink

DEADLINE_S = 5.0
GOOD = can.Message(arbitration_id=0x310, is_extended_id=False, data=b"\x01\x02")
ENOBUFS = OSError(errno.ENOBUFS, "No buffer space available")
FULL = can.CanOperationError("Failed to transmit: No buffer space available", error_code=errno.ENOBUFS)


class TerminalError(Exception):
    """As `termios.error`, which there is none of on Windows."""


TerminalError.__module__ = "termios"


class ScriptedBus:
    """Gives and raises what it is told to, the last of it over and over; then it is silent."""

    def __init__(self, received=(), sending=(), for_ever=False):
        self.received, self.sending, self.for_ever = list(received), list(sending), for_ever
        self.sent = []

    def recv(self, timeout):
        if not self.received:
            time.sleep(0.001)
            return None
        return raised_or(self.received[0] if self.for_ever else self.received.pop(0))

    def send(self, message, timeout):
        if self.sending:
            raised_or(self.sending[0] if self.for_ever else self.sending.pop(0))
        self.sent.append(message)

    def shutdown(self):
        raise RuntimeError("even that fails")


def raised_or(what):
    if isinstance(what, Exception):
        raise what
    return what


@contextmanager
def link_over(monkeypatch, bus):
    monkeypatch.setattr(can_link, "_open", lambda _: bus)
    link = CanLink(CanAddress(interface="virtual", channel="scripted"))
    try:
        yield link
    finally:
        link.close()


def eventually(holds):
    deadline_s = time.monotonic() + DEADLINE_S
    while not holds():
        assert time.monotonic() < deadline_s
        time.sleep(0.001)


def trouble(link):
    """What the link says once it has noticed."""
    said = []

    def noticed():
        try:
            link.check()
        except LinkLostError as error:
            said.append(str(error))
        return said

    eventually(noticed)
    return said[0]


@pytest.mark.parametrize(
    ("came", "counted"),
    [
        (IndexError("string index out of range"), "cut or garbled frames dropped: 1"),
        (ValueError("invalid literal for int() with base 16"), "cut or garbled frames dropped: 1"),
        (KeyError(17), "cut or garbled frames dropped: 1"),
        (FULL, "failures to receive, tried again: 1"),
        (OSError(errno.EINTR, "Interrupted"), "failures to receive, tried again: 1"),
        (TerminalError(5, "Input/output error"), "cut or garbled frames dropped: 1"),
        (can.Message(is_error_frame=True, arbitration_id=0x04), "error frames dropped: 1"),
        (can.Message(is_remote_frame=True, arbitration_id=0x310), "remote frames dropped: 1"),
        (can.Message(is_fd=True, arbitration_id=0x310, data=bytes(12)), "CAN FD frames dropped: 1"),
        (can.Message(arbitration_id=0x310, data=b"\x01", dlc=8), "cut frames dropped: 1"),
    ],
)
def test_what_is_no_frame_is_dropped_counted_and_the_next_one_is_heard(monkeypatch, came, counted):
    heard = []
    bus = ScriptedBus()
    with link_over(monkeypatch, bus) as link:
        link.subscribe(heard.append)
        bus.received += [came, GOOD]
        eventually(lambda: heard)
        assert heard == [GOOD]
        assert link.tally.words == counted
        link.check()


def test_an_error_that_a_listener_raises_is_the_trouble_of_the_link(monkeypatch):
    def stumble(_):
        raise RuntimeError("a bug of ours")

    bus = ScriptedBus()
    with link_over(monkeypatch, bus) as link:
        link.subscribe(stumble)
        bus.received.append(GOOD)
        assert "the link is lost (RuntimeError: a bug of ours)" in trouble(link)
        with pytest.raises(LinkLostError, match="a bug of ours"):
            link.send(0x100, b"")


@pytest.mark.parametrize("error", [FULL, IndexError("string index out of range"), ZeroDivisionError("anything")])
def test_a_bus_that_only_fails_is_lost_with_its_reason(monkeypatch, error):
    monkeypatch.setattr(can_link, "FAILING_S", 0.02)
    with link_over(monkeypatch, ScriptedBus(received=[error], for_ever=True)) as link:
        assert str(error) in trouble(link)


def test_a_bus_that_is_gone_is_lost_at_once(monkeypatch):
    with link_over(monkeypatch, ScriptedBus(received=[OSError(errno.ENODEV, "No such device")])) as link:
        assert "No such device" in trouble(link)


@pytest.mark.parametrize(
    "error", [ENOBUFS, FULL, TerminalError(5, "Input/output error"), OSError(errno.EAGAIN, "again")]
)
@pytest.mark.parametrize("times", [1, 4])
def test_a_frame_that_could_not_be_sent_for_a_moment_is_sent_all_the_same(monkeypatch, error, times):
    bus = ScriptedBus(sending=[error] * times)
    with link_over(monkeypatch, bus) as link:
        link.send(0x300, b"\x07")
        assert [bytes(message.data) for message in bus.sent] == [b"\x07"]
        assert link.tally.words == f"frames sent only after a failure: {times}"


@pytest.mark.parametrize(
    ("error", "granted_s"), [(ENOBUFS, 0.02), (ValueError("no such frame"), 0.02), (BrokenPipeError("gone"), 60.0)]
)
def test_a_frame_that_cannot_be_sent_is_a_lost_link_after_the_time_that_is_granted(monkeypatch, error, granted_s):
    monkeypatch.setattr(can_link, "SEND_TIMEOUT_S", granted_s)
    with link_over(monkeypatch, ScriptedBus(sending=[error], for_ever=True)) as link:
        for _ in range(2):
            with pytest.raises(LinkLostError, match=str(error).split("]")[-1]):
                link.send(0x300, b"")


@pytest.mark.parametrize(
    "error",
    [TerminalError(25, "Inappropriate ioctl"), RuntimeError("odd"), can.CanInitializationError("no"), TypeError("x")],
)
def test_whatever_an_interface_raises_at_opening_is_a_lost_link(monkeypatch, error):
    with link_over(monkeypatch, ScriptedBus()) as link:
        monkeypatch.setattr(can_link, "_open", lambda _: raised_or(error))
        with pytest.raises(LinkLostError, match=rf"the link is lost .{type(error).__name__}"):
            link.reopen(link.generation)
        with suppress(LinkLostError):
            link.check()
