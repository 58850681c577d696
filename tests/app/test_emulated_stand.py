"""The whole job through the wire: `tumble emulate` in a process of its own, `tumble calibrate` against it."""

import json
import os
import signal
import subprocess
import sys
from contextlib import contextmanager

import pytest

from calibrations.analysis import analyse
from procedures.recording.observations import observations
from procedures.recording.reader import read_recording

pytestmark = pytest.mark.skipif(os.name == "nt", reason="SIGINT cannot be sent to one process on Windows")

PROGRAMME = """
name = "short"
realisations = 2
dwell_s = 0.5

[[procedure]]
kind = "flip"
axes = ["x", "y"]

[[procedure]]
kind = "sweep"
mount = "face-down"
start_deg = 0.0
step_deg = 45.0
points = 5
"""
PAIRS = {
    "serial": (("zaber", "socket://127.0.0.1:0"), ("scpi", "socket://127.0.0.1:0")),
    "CAN": (("cia402", "socketcand:can0?host=127.0.0.1&port=0"), ("can", "socketcand:can0?host=127.0.0.1&port=0")),
}


def stand_file(path, head, daq):
    """A stand file; `head` and `daq` are driver and address."""
    path.write_text(
        f'name = "emulated"\n[head]\ndriver = "{head[0]}"\nurl = "{head[1]}"\nlimits_deg = [-180.0, 760.0]\n'
        f'speed_deg_s = 30.0\n[daq]\ndriver = "{daq[0]}"\nurl = "{daq[1]}"\nsamples = 50\n[simulated]\nseed = 3\n'
    )
    return path


@contextmanager
def emulated(stand):
    """An emulated stand in a process of its own, and where it is served."""
    command = [sys.executable, "-m", "app", "emulate", "--stand", str(stand), "--speed", "40"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield json.loads(process.stdout.readline())
        finally:
            process.send_signal(signal.SIGINT)
            assert process.wait(timeout=20) == 0


@pytest.mark.parametrize("pair", PAIRS)
def test_a_calibration_through_the_wire_recovers_the_unit(pair, tmp_path):
    (head, head_url), (daq, daq_url) = PAIRS[pair]
    programme = tmp_path / "short.toml"
    programme.write_text(PROGRAMME)
    served = stand_file(tmp_path / "served.toml", (head, head_url), (daq, daq_url))
    with emulated(served) as where:
        stand = stand_file(tmp_path / "stand.toml", (head, where["head"]), (daq, where["daq"]))
        recording = tmp_path / "run.mcap"
        command = [sys.executable, "-m", "app", "run", "--stand", str(stand), "--programme", str(programme)]
        command += ["--serial", "SN1", "--out", str(recording)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)

    assert done.returncode == 0, done.stderr
    rows = observations(read_recording(recording))
    assert len(rows) == 2 * (4 + 5)
    kx = analyse(rows, trials=0).parameters["kx"]
    assert abs(kx.value - 1.0) < 4 * kx.standard_uncertainty
