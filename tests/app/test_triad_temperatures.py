"""A triad at several temperatures, at the simulated stand with its chamber: soak, run, next; resumed in every phase."""

from bisect import bisect_right
from dataclasses import replace
from pathlib import Path

import pytest
from app_jobs import tumble

from benchmarks.endurance.two_axes import SIMULATED, SIMULATED_CHAMBER, WORLD
from tumble.procedures.events import ConditionAnswered, FinishReason
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.reader import read_recording

PROGRAMME = """method = "triad"
name = "two-temperatures"
temperatures_degC = [40, 25]
settle_s = 0.1

[soak]
window_s = 240.0
look_s = 30.0
slope_V_per_h = 1e-3

[[procedure]]
list = "8o"
"""
RUN = Path("run.mcap")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write()
    return tmp_path


def write():
    Path("p.toml").write_text(PROGRAMME, "utf-8")
    Path("stand.toml").write_text(f'name = "bench"\n{SIMULATED}\n{SIMULATED_CHAMBER}\n{WORLD}', "utf-8")


def run(*more):
    ran = tumble("run", "--programme", "p.toml", "--stand", "stand.toml", "--serial", "T1", "--out", "run.mcap", *more)
    return ran, read_recording(RUN) if RUN.exists() else None


def test_every_temperature_is_soaked_to_and_then_measured_at():
    ran, recording = run()
    assert ran.status == 0
    soaks = [event for event in recording.answers if isinstance(event, ConditionAnswered)]
    assert [soak.value for soak in soaks] == ["40", "25"]
    assert all("°C after" in soak.answer for soak in soaks)
    assert [point.conditions["chamber"] for point in recording.points] == ["40"] * 8 + ["25"] * 8
    for point in recording.points:
        assert point.temperature_degc == pytest.approx(float(point.conditions["chamber"]), abs=0.6)


def test_without_a_chamber_the_operator_is_asked():
    Path("stand.toml").write_text(f'name = "bench"\n{SIMULATED}\n{WORLD}', "utf-8")
    ran, recording = run()
    assert ran.status == 0
    assert [answer.answer for answer in recording.answers] == ["yes", "yes"]


def test_a_temperature_beyond_the_chamber_is_refused_before_anything_moves():
    Path("p.toml").write_text(PROGRAMME.replace("[40, 25]", "[40, 125]"), "utf-8")
    ran, recording = run()
    assert (ran.status, recording) == (2, None)
    assert "needs 125 °C, and the chamber goes from -40 to 120 °C" in ran.err


def timeless(point):
    readings = {name: replace(reading, temperature_degc=None) for name, reading in point.readings.items()}
    return replace(point, time_s=0.0, temperature_degc=None, readings=readings)


def cut(whole, points):
    """Break off after so many points; behind the last of a temperature that is in the next soak."""

    def left(length):
        RUN.write_bytes(whole[:length])
        try:
            return len(read_recording(RUN).points)
        except RecordingError:
            return -1

    assert left(bisect_right(range(len(whole)), points, key=left) - 1) == points


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A recording of a run that nothing happened to, as bytes, and its points."""
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(tmp_path_factory.mktemp("whole"))
        write()
        points = run()[1].points
        return RUN.read_bytes(), [timeless(point) for point in points]


@pytest.mark.parametrize("points", [0, 1, 7, 8, 9, 15])
def test_it_goes_on_after_a_kill_in_every_phase(whole, points):
    written, wanted = whole
    cut(written, points)
    resumed = tumble("resume", RUN)
    assert resumed.status == 0, resumed.err
    recording = read_recording(RUN)
    assert recording.ending.reason is FinishReason.COMPLETED
    assert [point.index for point in recording.points] == list(range(16))
    assert [timeless(point).positions_deg for point in recording.points] == [point.positions_deg for point in wanted]
    for now, then in zip(recording.points, wanted, strict=True):
        for channel, reading in now.readings.items():
            assert reading.mean == pytest.approx(then.readings[channel].mean, abs=2e-4)
