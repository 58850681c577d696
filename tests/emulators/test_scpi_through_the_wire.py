"""The real driver at the emulated multimeter through real ports, with everything that can happen on the way."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
import pytest

from tumble.drivers.attention import Attention
from tumble.drivers.errors import DeviceError, LinkLostError
from tumble.drivers.links import SerialLink
from tumble.drivers.scpi import ScpiMultimeter
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.scpi import Multimeter, ScpiSession
from tumble.emulators.serving import Server, serve_pty, serve_tcp
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld

on_posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")


@contextmanager
def served(
    serve: Callable[..., Server] = serve_tcp, *faults: dict[str, object]
) -> Iterator[tuple[Server, FasterClock]]:
    clock = FasterClock(100.0)
    world = SharedWorld(build(Simulated(noise_v=1e-3), clock=clock))
    script = FaultScript.model_validate({"fault": [{"device": "daq", **fault} for fault in faults]})
    due = Faults(script, "daq", clock)
    meter = Multimeter(world, due)
    with serve(partial(ScpiSession, meter), faults=due) as server:
        yield server, clock


@contextmanager
def meter_at(
    server: Server, clock: FasterClock, timeout_s: float = 0.3, check: Callable[[], object] = lambda: None
) -> Iterator[ScpiMultimeter]:
    link = SerialLink(server.url, device="multimeter", check=check)
    try:
        yield ScpiMultimeter(link, clock, temperature_sensor="FRTD", timeout_s=timeout_s)
    finally:
        link.close()


def assert_right(meter: ScpiMultimeter) -> None:
    block = meter.acquire(100, 100.0)
    assert len(block.voltage_v) == 100
    np.testing.assert_allclose(block.voltage_v, 2.49, atol=0.03)
    assert block.temperature_degc == pytest.approx(23.0, abs=0.5)


@pytest.mark.parametrize("serve", [serve_tcp, pytest.param(serve_pty, marks=on_posix)])
def test_a_block_comes_through(serve):
    with served(serve) as at, meter_at(*at) as meter:
        assert meter.identify().serial == "MY57200001"
        assert_right(meter)


@pytest.mark.parametrize("kind", ["late", "cut", "double", "garble", "reorder", "wrong_checksum"])
@pytest.mark.parametrize("containing", ["INIT", "FETC?", "SYST:ERR?", "*IDN?"])
def test_whatever_happens_to_an_answer_the_readings_are_right(kind, containing):
    fault = {"kind": kind, "at": {"command": 1, "containing": containing}, "lasts_s": 0.4}
    with served(serve_tcp, fault) as at, meter_at(*at) as meter:
        assert meter.identify().serial == "MY57200001"
        assert_right(meter)
        assert_right(meter)


@pytest.mark.parametrize("containing", ["INIT", "FETC?", "SYST:ERR?"])
def test_a_block_that_was_given_up_while_the_meter_was_silent_spoils_no_later_one(containing):
    fault = {"kind": "late", "at": {"command": 1, "containing": containing}, "lasts_s": 0.5}
    attention, asked = Attention(), []

    def stop():
        asked.append(True)
        if len(asked) > 8:
            raise KeyboardInterrupt

    with served(serve_tcp, fault) as at, meter_at(*at, timeout_s=3600.0, check=attention.check) as meter:
        meter.identify()
        with attention.paid_to(stop), pytest.raises(KeyboardInterrupt):
            while True:
                meter.acquire(100, 100.0)
        assert_right(meter)


def test_a_port_that_vanishes_is_lost_until_it_returns():
    fault = {"kind": "drop", "at": {"command": 1, "containing": "FETC?"}, "lasts_s": 0.2}
    with served(serve_tcp, fault) as at, meter_at(*at) as meter:
        before = meter.identify()
        with pytest.raises(LinkLostError):
            meter.acquire(100, 100.0)
        reconnect(meter)

        assert meter.identify() == before
        assert_right(meter)


def reconnect(meter: ScpiMultimeter) -> None:
    deadline_s = time.monotonic() + 5.0
    while True:
        try:
            meter.reconnect()
        except LinkLostError:
            assert time.monotonic() < deadline_s
        else:
            return


def test_a_thousand_readings_come_through():
    with served() as at, meter_at(*at) as meter:
        assert len(meter.acquire(1000, 1000.0).voltage_v) == 1000


def test_a_block_behind_which_an_error_is_queued_is_taken_anew():
    fault = {"kind": "error_queued", "at": {"command": 1, "containing": "INIT"}}
    with served(serve_tcp, fault) as at, meter_at(*at) as meter:
        meter.identify()
        assert_right(meter)


def test_a_meter_whose_errors_do_not_end_is_told_with_its_own_words():
    fault = {"kind": "error_queued", "at": {"command": 1, "containing": "INIT"}, "times": 3}
    with served(serve_tcp, fault) as at, meter_at(*at) as meter:
        meter.identify()
        with pytest.raises(DeviceError, match=r"failed to measure 3 times: .*System error.*look at its display"):
            meter.acquire(100, 100.0)
