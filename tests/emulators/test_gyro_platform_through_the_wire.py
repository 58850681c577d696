"""A gyro platform behind real protocols: what comes through the wire is what the stand in this process gives."""

import re
from contextlib import ExitStack

import numpy as np
import pytest
from gyro_stands import QUIET, SIMULATED, job_at, served, written

from tumble.app.running import run
from tumble.app.simulation import simulation
from tumble.app.wiring import connect
from tumble.drivers.errors import DeviceError
from tumble.emulators.backstage import find_backstage
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld
from tumble.procedures.events import FinishReason
from tumble.procedures.recording.reader import read_recording

EXAMPLES = ["gyro-lines", "gyro-can"]


@pytest.fixture(autouse=True)
def _unhurried(monkeypatch):
    """A thread that waits for its turn on a busy machine is no instrument with another rate."""
    monkeypatch.setattr("tumble.drivers.candaq.free._RATE_S", 1e3)
    monkeypatch.setattr("tumble.drivers.lines.gathered._RATE_S", 1e3)


def measured(job, connected, path):
    outcome = run(job, connected, path)
    assert outcome.reason is FinishReason.COMPLETED, outcome.message
    return read_recording(path)


def numbers(recording):
    """Means of all channels, shape (points, channels)."""
    return np.array([[reading.mean for reading in point.readings.values()] for point in recording.points])


@pytest.fixture(scope="module")
def in_process(tmp_path_factory):
    folder = tmp_path_factory.mktemp("here")
    stand = written(folder, SIMULATED)
    return measured(job_at(stand), connect(stand), folder / "run.mcap")


@pytest.mark.parametrize("example", EXAMPLES)
def test_a_platform_gives_what_the_simulated_stand_gives(example, in_process, tmp_path):
    with served(tmp_path, example) as stand:
        connected = stand.connect()
        try:
            through = measured(stand.job, connected, tmp_path / "run.mcap")
        finally:
            connected.links.close()
    assert [point.positions_deg for point in through.points] == [point.positions_deg for point in in_process.points]
    assert numbers(through) == pytest.approx(numbers(in_process), abs=2e-3)
    assert [point.temperature_degc for point in through.points] == pytest.approx([23.0] * 3, abs=0.01)


@pytest.mark.parametrize("example", EXAMPLES)
def test_it_says_who_it_is(example, tmp_path):
    with served(tmp_path, example) as stand:
        connected = stand.connect()
        identity = connected.stand.samplers["platform"].identify()
        connected.links.close()
    assert identity.serial in ("90001", "310002")


def complaint(tmp_path, kind):
    """What is said of a platform on the bus with which the same goes wrong again and again."""
    fault = {"device": "platform", "kind": kind, "at": {"time_s": 0.0}, "times": 10_000}
    with served(tmp_path, "gyro-can", fault) as stand:
        connected = stand.connect()
        platform = connected.stand.samplers["platform"]
        with pytest.raises(DeviceError) as told:
            for _ in range(40):
                platform.acquire(10, 10.0)
        connected.links.close()
    return str(told.value)


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [
        ("stale", "did not follow the one before, twice in a row"),
        ("other_unit", "levelling_rate_deg_h has had no value between -400 and 400 for 30 s"),
    ],
)
def test_what_goes_wrong_again_and_again_on_the_bus_is_told(kind, sentence, tmp_path):
    assert sentence in complaint(tmp_path, kind)


def test_garbled_frames_for_good_are_told_with_their_number(tmp_path, monkeypatch):
    monkeypatch.setattr("tumble.drivers.candaq.free.FIRST_FRAME_S", 0.2)
    monkeypatch.setattr("tumble.drivers.candaq.free.LATENESS_S", 0.1)
    assert re.search(r"sent 0 of 10 voltages \(.*checksum.* dropped: \d+\)", complaint(tmp_path, "garble"))


@pytest.mark.parametrize("example", EXAMPLES)
def test_what_goes_wrong_once_is_put_right(example, tmp_path):
    fault = {"device": "platform", "kind": "stale", "at": {"time_s": 3.0}}
    with served(tmp_path, example, fault) as stand:
        connected = stand.connect()
        block = connected.stand.samplers["platform"].acquire(100, 10.0)
        connected.links.close()
    assert np.ptp(block.channels["levelling_rate_deg_h"]) < 1e-2


def test_the_base_of_an_emulated_stand_is_leaned_backstage(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    with served(tmp_path, "gyro-lines") as stand:
        address = stand.job.stand.file.samplers["platform"].address
        backstage = find_backstage((address,))
        assert list(backstage.setters) == ["base"]
        backstage.setters["base"]("2")
        with pytest.raises(DeviceError, match="0 is no number of a lean"):
            backstage.setters["base"]("0")
        with pytest.raises(DeviceError, match="nobody sets mount here, only base"):
            backstage.seat("edge")


def test_a_simulated_platform_is_served_by_no_voltmeter(tmp_path):
    world = QUIET.replace("tilt_noise_deg = 0.0", "")
    stand = written(tmp_path, SIMULATED + 'channels = ["levelling_rate_deg_h"]', world)
    wanted = Wanted(samplers=stand.file.samplers, folder=tmp_path)
    with (
        ExitStack() as stack,
        pytest.raises(ValueError, match="channel levelling_rate_deg_h, which no voltmeter tells"),
    ):
        emulate(stack, SharedWorld(simulation(stand, FasterClock(1.0))), wanted)
