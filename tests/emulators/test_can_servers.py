import subprocess
import sys
import time
from contextlib import suppress

import can
import pytest
from can_bench import DEADLINE_S, STEPS_PER_DEG, CanBench, can_bench, raised, rested

from tumble.drivers.cia402 import Cia402Head
from tumble.drivers.clock import SystemClock
from tumble.drivers.errors import LinkLostError
from tumble.drivers.links.can_address import CanAddress
from tumble.drivers.links.can_link import CanLink
from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.slcan import SlcanSession, serve_slcan, slcan_address
from tumble.emulators.socketcand import SocketcandSession, serve_socketcand, socketcand_address

posix = pytest.mark.skipif(sys.platform == "win32", reason="there are no pseudo-terminals on Windows")
WAYS = [
    pytest.param((serve_socketcand, socketcand_address), id="socketcand"),
    pytest.param((serve_slcan, slcan_address), id="slcan", marks=posix),
]
DROP = {"device": "head", "kind": "drop", "at": {"time_s": 1.5}, "lasts_s": 0.5}


@pytest.fixture
def bench():
    with can_bench() as bench:
        yield bench


def head_on(link: CanLink) -> Cia402Head:
    return Cia402Head(
        link, 1, limits_deg=(-180.0, 760.0), steps_per_deg=STEPS_PER_DEG, speed_deg_s=20.0, clock=SystemClock()
    )


@pytest.fixture
def other(bench):
    with can.Bus(interface="virtual", channel=bench.channel, receive_own_messages=False) as other:
        yield other


@pytest.mark.parametrize("way", WAYS)
def test_a_head_is_homed_and_moved_through_the_server(bench: CanBench, way):
    serve, address = way
    with serve(bench.channel) as server:
        link = CanLink(CanAddress.from_url(address(server).url))
        head = head_on(link)
        head.home()
        rested(head)
        head.start_move(45.0)
        assert rested(head).angle_deg == 45.0
        link.close()


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("data", [b"", b"\x00\x0a", bytes(range(8))])
@pytest.mark.parametrize("can_id", [0x7A5, 0x1ABCDEF0])
def test_frames_go_through_both_ways_as_they_are(bench: CanBench, other, way, data: bytes, can_id: int):
    serve, address = way
    with serve(bench.channel) as server:
        came = []
        link = CanLink(address(server))
        link.subscribe(came.append)
        deadline_s = time.monotonic() + DEADLINE_S
        heard = None
        while heard is None or not came:  # a server may not be listening yet
            link.send(can_id, data)
            other.send(can.Message(arbitration_id=can_id, is_extended_id=can_id > 0x7FF, data=data))
            heard = other.recv(0.05)
            assert time.monotonic() < deadline_s
        for message in (heard, came[0]):
            assert (message.arbitration_id, bytes(message.data)) == (can_id, data)
            assert message.is_extended_id == (can_id > 0x7FF)
        link.close()


@pytest.mark.parametrize("way", WAYS)
def test_a_server_that_vanishes_is_a_lost_link_until_it_returns(bench: CanBench, way, monkeypatch):
    monkeypatch.setattr("tumble.drivers.cia402.node.PATIENCE_S", 0.6)
    monkeypatch.setattr("tumble.drivers.cia402.node.REPLY_TIMEOUT_S", 0.1)
    serve, address = way
    with serve(bench.channel, faults=Faults(FaultScript.model_validate({"fault": [DROP]}))) as server:
        head = head_on(CanLink(address(server)))
        raised(LinkLostError, head.status)
        deadline_s = time.monotonic() + DEADLINE_S
        while time.monotonic() < deadline_s:
            with suppress(LinkLostError):
                head.reconnect()
                break
        assert head.identify().serial == "402001"
        head._node._link.close()


def test_a_server_that_is_not_there_is_a_lost_link_at_once():
    address = CanAddress(interface="socketcand", channel="can0", options={"host": "127.0.0.1", "port": 9})
    began_s = time.monotonic()
    with pytest.raises(LinkLostError, match=r"socketcand:can0\?host=127.0.0.1&port=9: the link is lost"):
        CanLink(address)
    assert time.monotonic() - began_s < 5.0


@pytest.mark.parametrize(
    "url", ["slcan:/nowhere/tty", "nonsense:can0", "socketcand:can0", "socketcan:can-that-is-not-there"]
)
def test_a_bus_that_cannot_be_opened_is_a_lost_link(url: str):
    with pytest.raises(LinkLostError, match="check interface, cable"):
        CanLink(CanAddress.from_url(url))


def test_another_process_reaches_the_bus(bench: CanBench):
    with serve_socketcand(bench.channel) as server:
        program = (
            "import can, sys\n"
            f"bus = can.Bus(interface='socketcand', channel='can0', host='127.0.0.1', port={server.port})\n"
            "question = bytes([0x40, 0x18, 0x10, 4, 0, 0, 0, 0])\n"
            "bus.send(can.Message(arbitration_id=0x601, is_extended_id=False, data=question))\n"
            "while (message := bus.recv(5.0)).arbitration_id != 0x581: pass\n"
            "print(int.from_bytes(message.data[4:], 'little'))\n"
            "bus.shutdown()\n"
        )
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=30, check=True)
    assert done.stdout.strip() == "402001"


def test_a_link_shared_by_two_is_opened_anew_only_once(bench: CanBench):
    generation = bench.link.generation
    assert bench.link.reopen(generation) == generation + 1
    assert bench.link.reopen(generation) == generation + 1
    bench.link.check()


def test_a_closed_link_sends_nothing(bench: CanBench):
    bench.link.close()
    with pytest.raises(LinkLostError, match="it is closed"):
        bench.link.send(0x100, b"")


@pytest.mark.parametrize(
    "garbage", [b"< send 7FF 3 1 2 >", b"< send 3FFFFFFF 0 >", b"< send zzz 1 0 >", b">", b"< send 1 9 0 >", b"\xff>"]
)
def test_socketcand_passes_garbage_by(bench: CanBench, other, garbage: bytes):
    session = SocketcandSession(bench.channel)
    assert session.received(garbage) == b""
    assert other.recv(0.0) is None


def test_socketcand_speaks_of_frames_only_a_while_after_raw_mode_was_granted(bench: CanBench, other):
    session = SocketcandSession(bench.channel)
    assert session.due() == b"< hi >"
    assert session.received(b"< open can0 >") == b"< ok >"
    assert session.received(b"< rawmode >") == b"< ok >"
    other.send(can.Message(arbitration_id=0x40, is_error_frame=True))
    assert session.due() == b""
    deadline_s = time.monotonic() + DEADLINE_S
    while not (told := session.due()):
        assert time.monotonic() < deadline_s
    assert told.startswith(b"< error 00000040 ")


@pytest.mark.parametrize(
    ("command", "answer"),
    [
        (b"S6\r", b"\r"),
        (b"V\r", b"V1013\r"),
        (b"t1232AABB\r", b"z\r"),
        (b"T2234567811F\r", b"\a"),
        (b"T0234567811F\r", b"Z\r"),
        (b"t1233AABB\r", b"\a"),
        (b"tXYZ0\r", b"\a"),
        (b"\xff\xfe\r", b"\a"),
        (b"\r", b"\r"),
    ],
)
def test_slcan_answers_every_command(bench: CanBench, command: bytes, answer: bytes):
    session = SlcanSession(bench.channel)
    assert session.received(b"O\r") == b"\r"
    assert session.received(command) == answer


def test_slcan_neither_sends_nor_hears_while_its_channel_is_closed(bench: CanBench, other):
    session = SlcanSession(bench.channel)
    assert session.received(b"t1230\r") == b"\a"
    other.send(can.Message(arbitration_id=0x123, is_extended_id=False, data=b"\x01"))
    assert session.due() == b""
    session.received(b"O\r")
    assert session.due() == b""
    other.send(can.Message(arbitration_id=0x123, is_extended_id=False, data=b"\x01"))
    assert session.due() == b"t123101\r"
