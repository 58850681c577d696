"""The real driver at meters that take one query a message, through real ports, with what can happen on the way."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
import pytest

from tumble.drivers.errors import LinkLostError
from tumble.drivers.links import SerialLink
from tumble.drivers.scpi import ScpiMultimeter
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.scpi import Multimeter, ScpiSession
from tumble.emulators.scpi.models import Messages
from tumble.emulators.serving import Server, serve_pty, serve_tcp
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld

on_posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")
PORTS = [serve_tcp, pytest.param(serve_pty, marks=on_posix)]


@contextmanager
def meter_at(
    model: str,
    messages: Messages = "any",
    *faults: dict[str, object],
    serve: Callable[..., Server] = serve_tcp,
    common: bool = False,
) -> Iterator[ScpiMultimeter]:
    clock = FasterClock(100.0)
    world = SharedWorld(build(Simulated(noise_v=1e-3), clock=clock))
    script = FaultScript.model_validate({"fault": [{"device": "daq", **fault} for fault in faults]})
    due = Faults(script, "daq", clock)
    meter = Multimeter(world, due, model=model, messages=messages)
    with serve(partial(ScpiSession, meter), faults=due) as server:
        link = SerialLink(server.url, device="multimeter")
        try:
            yield ScpiMultimeter(link, clock, timeout_s=0.15, common=common)
        finally:
            link.close()


def assert_right(meter: ScpiMultimeter, rate_hz: float = 100.0, samples: int = 50) -> None:
    block = meter.acquire(samples, rate_hz)
    assert len(block.voltage_v) == samples
    np.testing.assert_allclose(block.voltage_v, 2.49, atol=0.03)


@pytest.mark.parametrize("serve", PORTS)
@pytest.mark.parametrize(
    ("model", "messages"),
    [
        ("34461A", "first"),
        ("34465A", "lines"),
        ("MODEL 2000", "any"),
        ("MODEL DMM6500", "any"),
        ("SDM3055", "first"),
        ("SDM3065X", "first"),
        ("DM3058", "one"),
    ],
)
def test_a_block_comes_through(model, messages, serve):
    with meter_at(model, messages, serve=serve) as meter:
        assert meter.identify().serial == "MY57200001"
        assert_right(meter)


@pytest.mark.parametrize("serve", PORTS)
@pytest.mark.parametrize("model", ["PLAIN-5", "READ-ONCE"])
def test_the_common_core_comes_through(model, serve):
    with meter_at(model, "one", serve=serve, common=True) as meter:
        remarks = meter.identify().remarks
        assert_right(meter, 2.0, 5)

    assert any("no checksum" in remark for remark in remarks) == (serve is serve_pty and model == "READ-ONCE")


@pytest.mark.parametrize("kind", ["late", "cut", "double", "garble", "reorder", "wrong_checksum"])
@pytest.mark.parametrize(
    ("model", "messages", "containing"),
    [
        ("34461A", "first", "FETC?"),
        ("34461A", "first", "*ESE?"),
        ("34461A", "first", "SYST:ERR?"),
        ("MODEL 2000", "any", "TRAC:DATA?"),
        ("MODEL 2000", "any", "*IDN?"),
        ("SDM3065X", "first", "TRIG:COUN?"),
    ],
)
def test_whatever_happens_to_an_answer_the_readings_are_right(model, messages, containing, kind):
    fault = {"kind": kind, "at": {"command": 1, "containing": containing}, "lasts_s": 0.2}
    with meter_at(model, messages, fault, {**fault, "at": {"command": 8, "containing": containing}}) as meter:
        assert meter.identify().serial == "MY57200001"
        assert_right(meter)
        assert_right(meter)


@pytest.mark.parametrize(("model", "messages"), [("34461A", "first"), ("MODEL 2000", "any")])
def test_power_lost_costs_a_block(model, messages):
    fault = {"kind": "power_loss", "at": {"command": 3, "containing": "INIT"}}
    with meter_at(model, messages, fault) as meter:
        meter.identify()
        assert_right(meter)
        assert_right(meter)


def test_a_port_that_vanishes_is_lost_and_not_taken_for_a_lesser_meter():
    fault = {"kind": "drop", "at": {"command": 2, "containing": "TRAC:DATA?"}, "lasts_s": 5.0}
    with meter_at("MODEL 2000", "any", fault) as meter, pytest.raises(LinkLostError):
        meter.identify()
