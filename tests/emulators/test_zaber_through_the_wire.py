"""The real driver on the emulated stage through real ports, with everything that can happen on the way."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

from benchmarks.endurance.rfc2217 import rfc2217_port
from tumble.drivers.errors import LinkLostError
from tumble.drivers.links import SerialLink
from tumble.drivers.simulated import HeadOptions, Simulated, build
from tumble.drivers.zaber import ZaberHead
from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.serving import Server, serve_pty, serve_tcp
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld
from tumble.emulators.zaber import EmulatedZaber

on_posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")


@contextmanager
def served(serve: Callable[..., Server] = serve_tcp, *faults: dict[str, object]) -> Iterator[Server]:
    clock = FasterClock(100.0)
    shared = SharedWorld(build(Simulated(), clock=clock, head=HeadOptions()))
    script = FaultScript.model_validate({"fault": [{"device": "head", **fault} for fault in faults]})
    instrument_faults = Faults(script, "head", clock)
    stage = EmulatedZaber(shared, steps_per_deg=1000.0, faults=instrument_faults)
    with serve(stage.session, faults=instrument_faults) as server:
        yield server


@contextmanager
def head_at(url: str, timeout_s: float = 0.5) -> Iterator[ZaberHead]:
    link = SerialLink(url, device="stage")
    try:
        yield ZaberHead(
            link,
            steps_per_deg=1000.0,
            limits_deg=(-180.0, 760.0),
            speed_deg_s=20.0,
            clock=FasterClock(100.0),
            timeout_s=timeout_s,
        )
    finally:
        link.close()


def settled_deg(head: ZaberHead) -> float:
    deadline_s = time.monotonic() + 10.0
    while (status := head.status()).moving:
        assert time.monotonic() < deadline_s
        time.sleep(0.005)
    return status.angle_deg


def home(head: ZaberHead) -> None:
    head.identify()
    head.home()
    settled_deg(head)


@pytest.mark.parametrize("serve", [serve_tcp, pytest.param(serve_pty, marks=on_posix)])
def test_it_homes_moves_and_stops(serve):
    with served(serve) as server, head_at(server.url) as head:
        home(head)
        head.start_move(90.0)
        assert settled_deg(head) == 90.0
        head.start_move(700.0)
        head.stop()
        assert 90.0 <= settled_deg(head) < 700.0


@pytest.mark.filterwarnings("ignore:set(Daemon|Name):DeprecationWarning")  # pyserial's own
def test_it_is_reached_through_rfc_2217():
    with served() as server, rfc2217_port(server.url) as url, head_at(url) as head:
        home(head)
        head.start_move(30.0)
        assert settled_deg(head) == 30.0


WIRE = ("late", "cut", "double", "garble", "reorder", "wrong_checksum")


@pytest.mark.parametrize("kind", WIRE)
def test_whatever_happens_to_answers_the_head_is_where_it_should_be(kind):
    commands = ("get pos", "move abs", "home", "stop", "warnings clear", "get system.serial", "set comm.checksum")
    faults = [{"kind": kind, "at": {"command": 1, "containing": command}, "lasts_s": 0.4} for command in commands]
    with served(serve_tcp, *faults) as server, head_at(server.url, timeout_s=0.25) as head:
        home(head)
        head.start_move(90.0)
        assert settled_deg(head) == 90.0
        head.stop()
        assert head.identify().serial == "51234"
        assert settled_deg(head) == 90.0


def test_a_move_under_way_when_the_link_is_lost_is_found_again():
    drop = {"kind": "drop", "at": {"command": 1, "containing": "move abs"}, "lasts_s": 0.1}
    with served(serve_tcp, drop) as server, head_at(server.url) as head:
        home(head)
        with pytest.raises(LinkLostError, match="stage: the link"):
            head.start_move(90.0)
        deadline_s = time.monotonic() + 5.0
        while True:
            try:
                head.reconnect()
                break
            except LinkLostError:
                assert time.monotonic() < deadline_s
        assert head.identify().serial == "51234"
        assert settled_deg(head) == 90.0
