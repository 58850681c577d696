"""Arbitrary bytes from an adapter and from a socketcand server: nothing but `ValueError`, and then good frames."""

import socket
import time
from contextlib import contextmanager

import can
import pytest
import serial
from hypothesis import given, settings
from hypothesis import strategies as st

from tumble.drivers.links.slcan import SlcanBus
from tumble.drivers.links.socketcand import SocketcandBus

DEADLINE_S = 1.0
PIECES = st.lists(
    st.one_of(
        st.binary(max_size=40),
        st.sampled_from(
            [b"t", b"T", b"r", b"d", b"310", b"8", b"0102", b"\r", b"\a", b"< frame ", b"310 ", b"1.0 ", b">"]
        ),
    ),
    max_size=12,
).map(b"".join)


class FedPort:
    """A serial port from which comes what it was fed."""

    write_timeout = None

    def __init__(self):
        self.fed = bytearray()

    @property
    def in_waiting(self):
        return len(self.fed)

    def read(self, size):
        piece = bytes(self.fed[:size])
        del self.fed[:size]
        return piece

    def write(self, data):
        return len(data)

    def flush(self):
        pass

    def close(self):
        pass


@contextmanager
def adapter():
    port, right = FedPort(), serial.serial_for_url
    serial.serial_for_url = lambda *_, **__: port
    try:
        bus = SlcanBus("COM3", sleep_after_open=0.0)
    finally:
        serial.serial_for_url = right
    try:
        yield port, bus
    finally:
        bus.shutdown()


@contextmanager
def server():
    """A server's side of the connection, and the bus of a client."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        client = socket.create_connection(listening.getsockname())
        ours, _ = listening.accept()
        ours.sendall(b"< hi >< ok >< ok >")
        right, socket.create_connection = socket.create_connection, lambda *_: client
        try:
            bus = SocketcandBus("can0", "127.0.0.1", 1)
        finally:
            socket.create_connection = right
        with ours:
            yield ours, bus
        bus.shutdown()


def heard(bus, good: can.Message) -> tuple[int, list[str]]:
    """How many frames came before the good one did, and what was said of what could not be read."""
    others, complaints = 0, []
    deadline_s = time.monotonic() + DEADLINE_S
    while time.monotonic() < deadline_s:
        try:
            message = bus.recv(0.0)
        except ValueError as error:
            complaints.append(str(error))
            continue
        if message is not None and message.equals(
            good, timestamp_delta=None, check_channel=False, check_direction=False
        ):
            return others, complaints
        others += message is not None
    raise AssertionError(f"the good frame did not come: {complaints}")


def frame(data: bytes, can_id: int = 0x310) -> can.Message:
    return can.Message(arbitration_id=can_id, is_extended_id=can_id > 0x7FF, data=data)


@settings(max_examples=100, deadline=None)
@given(PIECES)
def test_an_adapter_may_send_anything_and_the_next_good_line_is_heard(noise: bytes):
    with adapter() as (port, bus):
        port.fed += noise + b"\rt31080102030405060709\r"
        heard(bus, frame(bytes.fromhex("0102030405060709")))


def test_a_line_that_an_adapter_cut_after_three_characters_is_dropped():
    with adapter() as (port, bus):
        port.fed += b"t31080102030405060708\rt310\rt31080102030405060709\r"
        assert heard(bus, frame(bytes.fromhex("0102030405060709"))) == (1, ["b't310' is no frame"])


@pytest.mark.parametrize("length", range(21))
def test_a_line_cut_anywhere_is_never_taken_for_a_frame(length: int):
    with adapter() as (port, bus):
        port.fed += b"t31080102030405060708"[:length] + b"\rt3101FF\r"
        others, complaints = heard(bus, frame(b"\xff"))
        assert (others, len(complaints)) == (0, int(length > 0))


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (b"T1ABCDEF02C0DE", frame(b"\xc0\xde", 0x1ABCDEF0)),
        (b"x1ABCDEF00", frame(b"", 0x1ABCDEF0)),
        (b"t3102c0deF00D", frame(b"\xc0\xde")),
        (b"t3102C0DE0000F00D", frame(b"\xc0\xde")),
        (b"z\rZ\r\a\rV1013\rNT402\rF00\rt3102C0DE", frame(b"\xc0\xde")),
    ],
)
def test_good_lines_of_every_adapter_are_read(line: bytes, message: can.Message):
    with adapter() as (port, bus):
        port.fed += line + b"\r"
        assert heard(bus, message) == (0, [])


def test_frames_of_other_kinds_are_told_as_such():
    with adapter() as (port, bus):
        port.fed += b"r3108\rR1ABCDEF00\rd310F" + 64 * b"00" + b"\r"
        messages = [bus.recv(0.0) for _ in range(3)]
        assert [(m.is_remote_frame, m.is_fd) for m in messages] == [(True, False), (True, False), (False, True)]


def test_a_flood_without_the_end_of_a_line_is_dropped():
    with adapter() as (port, bus):
        port.fed += b"0" * 10_000
        with pytest.raises(ValueError, match="256 bytes without the end of a line"):
            bus.recv(0.0)
        port.fed += b"\rt3101FF\r"
        heard(bus, frame(b"\xff"))


@settings(max_examples=100, deadline=None)
@given(PIECES)
def test_a_server_may_send_anything_and_the_next_good_message_is_heard(noise: bytes):
    with server() as (ours, bus):
        ours.sendall(noise + b"><< frame 310 1.000000 C0DE >")
        heard(bus, frame(b"\xc0\xde"))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"< frame 310 1.000000 C0DE >", frame(b"\xc0\xde")),
        (b"< frame 310 1.000000 c0 de >", frame(b"\xc0\xde")),
        (b"< frame 310 1.000000  >", frame(b"")),
        (b"< frame 1ABCDEF0 23.424242 01 >", frame(b"\x01", 0x1ABCDEF0)),
    ],
)
def test_good_messages_of_every_server_are_read(text: bytes, message: can.Message):
    with server() as (ours, bus):
        ours.sendall(text)
        assert heard(bus, message) == (0, [])


@pytest.mark.parametrize(
    "text",
    [
        b"< frame 310 1.0 0 >",
        b"< frame 31 1.0 01 >",
        b"< frame 310 1.0 010203040506070809 >",
        b"< frame 3FFFFFFF 1.0 >",
        b"< frame",
        b"\xff\xfe >",
        b"< send 310 1 1 >",
    ],
)
def test_what_is_no_message_is_dropped_and_never_taken_for_a_frame(text: bytes):
    with server() as (ours, bus):
        ours.sendall(text + b"< frame 310 1.000000 C0DE >")
        others, complaints = heard(bus, frame(b"\xc0\xde"))
        assert (others, len(complaints)) == (0, 1)


def test_a_server_that_leaves_is_noticed():
    with server() as (ours, bus):
        ours.close()
        with pytest.raises(ConnectionError):
            bus.recv(1.0)


@pytest.mark.parametrize("greeting", [b"hello?>", b"\xff\xfe >", b"< error no such bus >", b""])
def test_who_does_not_greet_is_no_server(monkeypatch, greeting: bytes):
    monkeypatch.setattr("tumble.drivers.links.socketcand.CONNECT_TIMEOUT_S", 0.05)
    with socket.create_server(("127.0.0.1", 0)) as listening:
        client = socket.create_connection(listening.getsockname())
        ours, _ = listening.accept()
        ours.sendall(greeting)
        monkeypatch.setattr(socket, "create_connection", lambda *_: client)
        with ours, pytest.raises((OSError, ValueError)):
            SocketcandBus("can0", "127.0.0.1", 1)
