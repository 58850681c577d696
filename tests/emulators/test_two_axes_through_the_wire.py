"""A stand with two axes behind real protocols: what comes through the wire is what the stand in this process gives."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.endurance.two_axes import (
    CAN_DAQS,
    CIA402,
    MANUAL,
    METERS,
    SCANNER,
    SIMULATED,
    ZABER,
    ZABER_CHAIN,
    ZABER_LINES,
    job_at,
    served,
    stand_of,
)
from tumble.app.measurements import read_measurement
from tumble.app.running import run
from tumble.app.wiring import connect
from tumble.calibrations.methods.triad.loop import declared_fit
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.events import FinishReason
from tumble.procedures.recording.reader import read_recording

SHORT = """method = "triad"
name = "short"
settle_s = 0.1
settle_tolerance_v = 1.0

[[procedure]]
list = "8o"
"""
PAIRS = [
    (ZABER, SCANNER),
    (ZABER_CHAIN, METERS),
    (ZABER_LINES, SCANNER),
    (CIA402, SCANNER),
    (CIA402, CAN_DAQS),
    (MANUAL, SCANNER),
]
NAMES = [
    "zaber-scanner",
    "zaber chain-meters",
    "zaber lines-scanner",
    "cia402-scanner",
    "cia402-can daqs",
    "manual-scanner",
]


def measured(job, connected, path):
    outcome = run(job, connected, path)
    assert outcome.reason is FinishReason.COMPLETED, outcome.message
    return read_recording(path)


@pytest.fixture(scope="module")
def in_process(tmp_path_factory):
    folder = tmp_path_factory.mktemp("here")
    stand = stand_of(folder, SIMULATED, {})
    return measured(job_at(stand, SHORT), connect(stand), folder / "run.mcap")


@pytest.mark.parametrize("pair", PAIRS, ids=NAMES)
def test_a_pair_gives_what_the_simulated_stand_gives(pair, in_process, tmp_path: Path):
    with served(tmp_path, "\n".join(pair), SHORT) as stand:
        connected = stand.connect()
        try:
            through = measured(stand.job, connected, tmp_path / "run.mcap")
        finally:
            connected.links.close()
    assert [point.positions_deg for point in through.points] == [point.positions_deg for point in in_process.points]
    fits = [declared_fit(read_measurement(each.path).observations).fit for each in (through, in_process)]
    off = np.abs(fits[0].values - fits[1].values) / np.sqrt(np.diag(fits[1].parameter_covariance))
    assert off.max() < 0.1


def test_the_scanner_gives_every_channel_its_temperature(tmp_path):
    with served(tmp_path, "\n".join((ZABER, SCANNER)), SHORT) as stand:
        connected = stand.connect()
        scanner = connected.stand.samplers["scanner"]
        block = scanner.acquire(5, 10.0)
        connected.links.close()
    assert set(block.temperatures_degc) == {"u_x_v", "u_y_v", "u_z_v"}
    assert all(degc == pytest.approx(23.0, abs=0.1) for degc in block.temperatures_degc.values())


def test_both_axes_are_under_way_at_once_and_both_are_braked(tmp_path):
    with served(tmp_path, "\n".join((ZABER, SCANNER)), SHORT, speed=5.0) as stand:
        connected = stand.connect()
        outer, inner = (connected.stand.positioners[name] for name in ("outer", "inner"))
        for axis in (outer, inner):
            axis.identify()
            axis.home()
        while any(axis.status().moving for axis in (outer, inner)):
            stand.clock.sleep(0.1)
        outer.start_move(150.0)
        inner.start_move(-150.0)
        moving = [axis.status().moving for axis in (outer, inner)]
        outer.stop()
        inner.stop()
        stopped = [axis.status() for axis in (outer, inner)]
        connected.links.close()
    assert moving == [True, True]
    assert [status.moving for status in stopped] == [False, False]
    assert all(0.0 < abs(status.angle_deg) < 150.0 for status in stopped)


@pytest.mark.parametrize("axis", ["outer", "inner"])
def test_each_axis_has_limits_of_its_own(axis, tmp_path):
    table = f'[positioners.{axis}]\ndriver = "simulated"\nlimits_deg = '
    narrow = SIMULATED.replace(f"{table}[-190.0, 190.0]", f"{table}[-10.0, 10.0]")
    stand = stand_of(tmp_path, narrow, {})
    with pytest.raises(ProgrammeError, match=f"outside the {axis}'s limits of -10 to 10 deg"):
        job_at(stand, SHORT).plan()


@pytest.mark.parametrize("axis", ["outer", "inner"])
def test_each_axis_has_a_cable_of_its_own(axis, tmp_path):
    short = SIMULATED.replace(f"[positioners.{axis}]\n", f"[positioners.{axis}]\ncable_turns = 0.25\n")
    stand = stand_of(tmp_path, short, {})
    with pytest.raises(ProgrammeError, match=r"the cable allows 0\.25 turns"):
        job_at(stand, SHORT).plan()
