"""A wait for an instrument is broken off many times sooner than its patience ends, whatever is waited for."""

import socket
import time

import numpy as np
import pytest
import serial
from scpi_bench import emulated
from somebody_stops import Stop, StoppedError
from test_lines import counted, form

from tumble.drivers.attention import Attention, AttentiveClock
from tumble.drivers.candaq.declaration import CAN
from tumble.drivers.chamber.declaration import MODBUS
from tumble.drivers.cia402.declaration import CIA402
from tumble.drivers.clock import SystemClock, VirtualClock
from tumble.drivers.driver import Bench
from tumble.drivers.generator.declaration import GENERATOR
from tumble.drivers.lines.declaration import LINES
from tumble.drivers.lines.sampler import LineSampler, Requests
from tumble.drivers.links.opened import Links
from tumble.drivers.scpi import ScpiMultimeter
from tumble.drivers.scpi.declaration import SCPI
from tumble.drivers.scpi.scanner_declaration import SCANNER
from tumble.drivers.simulated import Simulated
from tumble.drivers.zaber.declaration import ZABER

HEAD = {"limits_deg": [-180.0, 180.0], "speed_deg_s": 20.0, "steps_per_deg": 3600.0}
DAQ = {"samples": 10, "rate_hz": 10.0}
SILENT = {
    "zaber": (ZABER, HEAD),
    "scpi": (SCPI, DAQ),
    "scpi that is common": (SCPI, DAQ | {"dialect": "common"}),
    "scanner": (SCANNER, DAQ | {"scan": {"u_v": 101}}),
    "lines by themselves": (LINES, DAQ | {"columns": ["u"], "measured": {"u_v": {"column": "u"}}}),
    "lines on request": (LINES, DAQ | {"columns": ["u"], "measured": {"u_v": {"column": "u"}}, "request": "R?"}),
    "generator": (
        GENERATOR,
        {
            "level_limit_g": 9.0,
            "frequency_limits_Hz": [10.0, 99.0],
            "references": {"r_v": 0.1},
            "outputs": {"x": {"channel": 1, "g_per_v": 2.0}},
        },
    ),
    "chamber": (
        MODBUS,
        {
            "limits_degC": [0.0, 50.0],
            "safe_degC": 20.0,
            "timeout_s": 60.0,
            "registers": {"actual": {"input": 1}, "setpoint": {"holding": 2}},
        },
    ),
    "drive": (CIA402, HEAD),
    "can": (CAN, DAQ),
}


@pytest.fixture
def silent():
    """A place where a connection is taken and nothing is ever said."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield f"socket://127.0.0.1:{server.getsockname()[1]}"


@pytest.fixture
def bench(tmp_path):
    attention, links = Attention(), Links()
    yield Bench(clock=SystemClock(), links=links, folder=tmp_path, eyepiece=None, check=attention.check), attention
    links.close()


@pytest.mark.parametrize("kind", SILENT)
def test_nobody_waits_behind_a_silent_line(bench, silent, kind):
    bench, attention = bench
    driver, keys = SILENT[kind]
    url = f"virtual:{kind}" if driver in (CIA402, CAN) else silent
    table = driver.table.model_validate({"driver": kind, "url": url, **keys})
    stop = Stop()
    with attention.paid_to(stop), pytest.raises(StoppedError):
        driver.connect(table, bench.attentive if driver in (SCPI, SCANNER, LINES, CAN) else bench).identify()
    assert max(np.diff(stop.moments_s)) < 0.4


class Chatter:
    """A port from which bytes come without pause."""

    in_waiting = 1

    def read(self, size):
        time.sleep(0.01)
        return b"x" * size

    def write(self, data):
        pass


@pytest.mark.parametrize("kind", ["zaber", "scpi", "lines on request"])
def test_nobody_waits_until_a_line_falls_silent(bench, monkeypatch, kind):
    bench, attention = bench
    monkeypatch.setattr(serial, "serial_for_url", lambda *_, **__: Chatter())
    driver, keys = SILENT[kind]
    table = driver.table.model_validate({"driver": kind, "url": "COM7", **keys})
    stop = Stop()
    with attention.paid_to(stop), pytest.raises(StoppedError):
        driver.connect(table, bench.attentive).identify()
    assert max(np.diff(stop.moments_s)) < 0.4


def test_a_clock_waits_no_longer_than_it_is_told():
    clock = VirtualClock()
    AttentiveClock(clock, lambda: None).sleep(43.21)
    assert clock.monotonic_s() == pytest.approx(43.21, abs=1e-12)


def stopping_at(clock, moment_s):
    """Raises from a moment of a clock on."""

    def stop():
        if clock.monotonic_s() >= moment_s:
            raise StoppedError

    return stop


def attentive_meter(model, **options):
    link, clock = emulated(Simulated(noise_v=0.0), model=model)
    attention = Attention()
    meter = ScpiMultimeter(link, AttentiveClock(clock, attention.check), **options)
    meter.identify()
    return meter, clock, attention


@pytest.mark.parametrize("model", ["34461A", "34465A", "SDM3055", "MODEL 2000", "MODEL DMM6500"])
def test_a_block_that_takes_its_time_is_broken_off_and_spoils_no_later_one(model):
    meter, clock, attention = attentive_meter(model)
    before = meter.acquire(4, 10.0).voltage_v
    now_s = clock.monotonic_s()
    with attention.paid_to(stopping_at(clock, now_s + 2.0)), pytest.raises(StoppedError):
        meter.acquire(500, 10.0)
    assert clock.monotonic_s() < now_s + 2.2
    assert meter.acquire(4, 10.0).voltage_v == pytest.approx(before, abs=1e-5)
    assert clock.monotonic_s() < now_s + 5.0


@pytest.mark.parametrize("model", ["34461A", "READ-ONCE"])
def test_so_is_one_whose_readings_are_taken_one_by_one(model):
    meter, clock, attention = attentive_meter(model, common=True)
    now_s = clock.monotonic_s()
    with attention.paid_to(stopping_at(clock, now_s + 16.0)), pytest.raises(StoppedError):
        meter.acquire(10, 0.1)
    assert clock.monotonic_s() < now_s + 16.1


class Answering:
    """A line that answers every request at once."""

    def __init__(self):
        self.lines = iter(counted(range(100)))

    def write(self, data):
        pass

    def read_line(self, _terminator, _timeout_s):
        return next(self.lines)

    def discard_input(self):
        pass

    def reopen(self):
        pass


def test_so_is_the_pause_between_two_requests_for_a_line():
    clock, attention = VirtualClock(), Attention()
    attentive = AttentiveClock(clock, attention.check)
    sampler = LineSampler(Answering(), form(), attentive, Requests(line="R?"), modulus=65_536)
    with attention.paid_to(stopping_at(clock, 25.0)), pytest.raises(StoppedError):
        sampler.acquire(10, 0.1)
    assert clock.monotonic_s() < 25.1
