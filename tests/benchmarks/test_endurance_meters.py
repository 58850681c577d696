"""A whole short programme with every family of meters, over sockets and pseudo-terminals."""

import os
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack

import numpy as np
import pytest

from tumble.app.running import Job, run
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.drivers.simulated import HeadOptions, Simulated, build
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.reader import read_recording

PROGRAMME = """\
name = "short"
settle_s = 0.05
dwell_s = 0.2

[[procedure]]
kind = "sweep"
mount = "face-up"
step_deg = 90.0
points = 3
"""
STAND = """\
name = "emulated"
[simulated]
seed = 3

[head]
driver = "zaber"
url = "{head}"
limits_deg = [-180.0, 760.0]
speed_deg_s = 90.0
[daq]
driver = "scpi"
url = "{daq}"
samples = 10
rate_hz = 50.0
"""
posix = pytest.mark.skipif(os.name == "nt", reason="Windows has no pseudo-terminals")


METERS = [
    ("34461A", "one", ""),
    ("MODEL 2000", None, ""),
    ("MODEL DMM6500", None, ""),
    ("SDM3055", None, ""),
    ("DM3068", None, ""),
    ("PLAIN-5", None, 'dialect = "common"'),
]
AT_TERMINALS = [("MODEL 2000", None, ""), ("READ-ONCE", None, 'dialect = "common"')]
ALL = [(*meter, True) for meter in AT_TERMINALS] + [(*meter, False) for meter in reversed(METERS)]


def measured(meter, folder):
    """Run the programme with a meter: its recording, and how many points were announced."""
    model, messages, more, terminals = meter
    clock = FasterClock(10.0)
    shared = SharedWorld(build(Simulated(seed=3), clock=clock, head=HeadOptions(speed_deg_s=90.0)))
    file, recording = folder / "stand.toml", folder / "run.mcap"
    anywhere = dict.fromkeys(("head", "daq"), "socket://127.0.0.1:0")
    file.write_text(STAND.format(**anywhere) + more)
    tables = load_stand(file).file
    with ExitStack() as stack:
        wanted = Wanted(head=tables.head, daq=tables.daq, meter=model, meter_messages=messages, ptys=terminals)
        where = emulate(stack, shared, wanted)
        suffix = "_pty" if terminals else ""
        file.write_text(STAND.format(**{name: where[f"{name}{suffix}"] for name in anywhere}) + more)
        job = Job(stand=load_stand(file), programme=programme_from_text(PROGRAMME, "short"), serial_number="E-1")
        connected = connect(job.stand, clock=clock)
        stack.callback(connected.links.close)
        return recording, len(run(job, connected, recording).points)


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """A run with every meter, some at a time: most of it is waiting for answers that a meter does not give."""
    there = ALL if os.name != "nt" else [meter for meter in ALL if not meter[3]]
    with ThreadPoolExecutor(4) as pool:
        return {meter: pool.submit(measured, meter, tmp_path_factory.mktemp("meter")) for meter in there}


@pytest.mark.parametrize("meter", [pytest.param(meter, marks=posix if meter[3] else ()) for meter in ALL], ids=str)
def test_a_whole_programme_comes_through(runs, meter):
    recording, points = runs[meter].result()

    rows = observations(read_recording(recording))
    assert points == len(rows.row) == 3
    np.testing.assert_allclose(rows.voltage_v, [2.5, 1.5, 2.5], atol=0.1)


def test_what_a_meter_cannot_is_recorded_with_the_run(tmp_path):
    recording, _ = measured(("SDM3065X", None, "", False), tmp_path)

    said = [event.message for event in read_recording(recording).events if hasattr(event, "message")]
    assert "DAQ: does not know VOLT:DC:FILT, which is left as it is" in said
