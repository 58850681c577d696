import io
import json
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import pytest
from app_jobs import STAND, take_again_once, tumble

from tumble.app.resuming import _elapsed_s, find
from tumble.drivers.clock import ReleasedClock
from tumble.procedures.events import FinishReason, PointCompleted, PointVerified, RunFinished, RunResumed
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.writer import Recorder

TWICE = """\
name = "twice"
realisations = 2
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "flip"
axes = ["x", "y"]

[[procedure]]
kind = "sweep"
step_deg = 60.0
points = 6
"""
"""Twenty dwells in two mounts and two realisations."""
POINTS = 20

KILLED = """\
import os, signal, sys
from tumble.app.cli import main
from tumble.procedures.events import PointCompleted
from tumble.procedures.recording.writer import Recorder

last, record = int(sys.argv.pop(1)), Recorder.record

def record_and_die(recorder, event):
    record(recorder, event)
    if isinstance(event, PointCompleted) and event.point.index == last:
        os.kill(os.getpid(), signal.SIGKILL)

Recorder.record = record_and_die
main()
"""


@pytest.fixture
def programme(write):
    return write("twice.toml", TWICE)


@pytest.fixture
def copy_at(monkeypatch):
    """Has what is on the disk copied when a point was completed: what a process that is killed then leaves."""

    def arrange(index, target):
        record = Recorder.record

        def record_and_copy(recorder, event):
            record(recorder, event)
            if isinstance(event, PointCompleted) and event.point.index == index and not target.exists():
                shutil.copyfile(recorder.path, target)

        monkeypatch.setattr(Recorder, "record", record_and_copy)

    return arrange


@pytest.fixture(scope="module")
def cut_everywhere(tmp_path_factory):
    """The programme run once: the whole recording, and what was on the disk after each point; to be copied."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "twice.toml").write_text(TWICE, "utf-8")
    record = Recorder.record

    def record_and_copy(recorder, event):
        record(recorder, event)
        if isinstance(event, PointCompleted):
            shutil.copyfile(recorder.path, folder / f"{event.point.index}.mcap")

    with patch.object(Recorder, "record", record_and_copy):
        ran = tumble("run", "--programme", folder / "twice.toml", "--serial", "A", "--out", folder / "whole.mcap")
    assert ran.status == 0, ran.err
    return folder


@pytest.fixture
def cut(programme, tmp_path, copy_at, cut_everywhere):
    """Runs a programme; returns the whole recording, and one that was cut off after a number of points."""

    def run(points, *options):
        whole, broken = tmp_path / "whole.mcap", tmp_path / "run.mcap"
        if options:
            copy_at(points - 1, broken)
            assert tumble("run", "--programme", programme, "--serial", "A", "--out", whole, *options).status == 0
        else:
            shutil.copyfile(cut_everywhere / "whole.mcap", whole)
            shutil.copyfile(cut_everywhere / f"{points - 1}.mcap", broken)
        assert len(read_recording(broken).points) == points
        return whole, broken

    return run


def measured(recording):
    """Everything of the points but their time, which is a sum of floating-point numbers."""
    return [replace(point, time_s=0.0, temperature_degc=None) for point in recording.points]


@pytest.mark.parametrize("points", [1, 3, 4, 9, 10, 11, 19])
def test_a_run_that_was_killed_ends_as_if_it_had_not_been(cut, points):
    whole, broken = cut(points)
    ran = tumble("resume", broken, "--json", "-")
    assert ran.status == 0, ran.err
    assert json.loads(ran.out) == {"schema": "tumble.run/1", "recording": str(broken), "points": POINTS}
    expected, resumed = read_recording(whole), read_recording(broken)
    assert resumed.complete
    assert measured(resumed) == measured(expected)
    assert [p.time_s for p in resumed.points] == pytest.approx([p.time_s for p in expected.points], abs=1e-6)
    assert [event.point for event in iter_samples(broken)] == list(range(POINTS))
    assert len(read_recording(broken.with_name("run.cut-1.mcap")).points) == points


def test_a_process_that_was_really_killed_loses_no_point(programme, tmp_path):
    broken = tmp_path / "run.mcap"
    arguments = ["run", "--programme", programme, "--serial", "A", "--out", broken]
    killed = subprocess.run([sys.executable, "-c", KILLED, "6", *map(str, arguments)], cwd=Path.cwd(), check=False)
    assert killed.returncode != 0
    assert len(read_recording(broken).points) == 7
    assert tumble("resume", broken).status == 0
    assert [point.index for point in read_recording(broken).points] == list(range(POINTS))


def test_the_recording_tells_of_the_interruption(cut):
    _, broken = cut(12)
    tumble("resume", broken)
    events = read_recording(broken).events
    (seen,) = [event for event in events if isinstance(event, PointVerified)]
    assert seen.point == 11
    assert abs(seen.now - seen.recorded) < seen.allowed
    assert RunResumed(points=12) in events
    moments = [json.loads(said.data)["monotonic_s"] for said in _said(broken)]
    assert moments == sorted(moments)


def _said(path):
    from tumble.procedures.recording.reader import complete_messages

    return list(complete_messages(read_recording(path)))


def test_a_run_may_be_cut_off_and_resumed_again(cut, copy_at, tmp_path):
    whole, broken = cut(5)
    again = tmp_path / "again.mcap"
    copy_at(13, again)
    tumble("resume", broken)
    shutil.copyfile(again, broken)
    ran = tumble("resume", broken)
    assert ran.status == 0, ran.err
    assert measured(read_recording(broken)) == measured(read_recording(whole))
    assert sorted(path.name for path in tmp_path.glob("run*")) == ["run.cut-1.mcap", "run.cut-2.mcap", "run.mcap"]


def test_a_run_in_which_a_point_was_taken_again_goes_on_too(programme, tmp_path, monkeypatch, copy_at):
    whole, broken = tmp_path / "whole.mcap", tmp_path / "run.mcap"
    copy_at(6, broken)
    take_again_once(monkeypatch, 3)
    assert tumble("run", "--programme", programme, "--serial", "A", "--out", whole).status == 0
    assert [point.take for point in read_recording(broken).points] == [1, 1, 1, 2, 1, 1, 1]
    ran = tumble("resume", broken)
    assert ran.status == 0, ran.err
    assert measured(read_recording(broken)) == measured(read_recording(whole))
    assert [event.point for event in iter_samples(broken)] == [0, 1, 2, 3, *range(3, POINTS)]


def test_a_run_that_was_stopped_goes_on_too(programme, tmp_path, monkeypatch):
    broken = tmp_path / "run.mcap"
    record = Recorder.record

    def interrupt(recorder, event):
        record(recorder, event)
        if isinstance(event, PointCompleted) and event.point.index == 3:
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(Recorder, "record", interrupt)
        assert tumble("run", "--programme", programme, "--serial", "A", "--out", broken).status == 4
    assert tumble("resume", broken).status == 0
    resumed = read_recording(broken)
    assert resumed.complete
    assert [event.reason for event in resumed.events if isinstance(event, RunFinished)] == [
        FinishReason.STOPPED,
        FinishReason.COMPLETED,
    ]


def test_a_kill_between_renaming_and_beginning_anew_loses_nothing(cut, tmp_path):
    whole, broken = cut(9)
    broken.rename(tmp_path / "run.cut-1.mcap")
    ran = tumble("resume", broken)
    assert ran.status == 0, ran.err
    assert measured(read_recording(broken)) == measured(read_recording(whole))
    assert sorted(path.name for path in tmp_path.glob("run*")) == ["run.cut-1.mcap", "run.mcap"]


@pytest.mark.parametrize("left", [0, 100, 4000, 9000])
def test_a_kill_while_the_file_is_begun_anew_loses_nothing(cut, tmp_path, left):
    whole, broken = cut(9)
    content = broken.read_bytes()
    broken.rename(tmp_path / "run.cut-1.mcap")
    broken.write_bytes(content[:left])
    ran = tumble("resume", tmp_path / "run.cut-1.mcap")
    assert ran.status == 0, ran.err
    assert measured(read_recording(broken)) == measured(read_recording(whole))
    assert (tmp_path / "run.cut-2.mcap").read_bytes() == content[:left]


def test_a_run_that_was_complete_is_left_as_it_is(cut):
    whole, _ = cut(5)
    content = whole.read_bytes()
    assert tumble("resume", whole).status == 0
    assert whole.read_bytes() == content


def test_a_run_whose_last_words_are_missing_is_closed_properly(cut):
    whole, _ = cut(5)
    whole.write_bytes(whole.read_bytes()[:-200])
    assert not read_recording(whole).complete
    assert tumble("resume", whole).status == 0
    assert read_recording(whole).complete


def test_a_calibration_goes_on_to_its_record_and_its_report(programme, tmp_path, copy_at, no_report):
    store, cut_off = tmp_path / "store", tmp_path / "cut.mcap"
    copy_at(14, cut_off)
    first = tumble("calibrate", "--programme", programme, "--serial", "A", "--store", store, "--json", "-")
    recording = Path(json.loads(first.out)["recording"])
    shutil.rmtree(store)
    recording.parent.mkdir(parents=True)
    shutil.copyfile(cut_off, recording)

    ran = tumble("resume", recording, "--json", "-")

    assert ran.status == 0, ran.err
    again = json.loads(ran.out)
    assert again["parameters"] == json.loads(first.out)["parameters"]
    assert Path(again["report"]).is_file()
    assert "--store" in tumble("resume", _moved(recording, tmp_path / "moved.mcap")).complaint


@pytest.fixture
def finished(programme, tmp_path, no_report):
    """A store with a calibration that is finished, and what it said."""
    store = tmp_path / "store"
    ran = tumble("calibrate", "--programme", programme, "--serial", "A", "--store", store, "--json", "-")
    assert ran.status == 0, ran.err
    return store, json.loads(ran.out)


def test_a_calibration_that_is_finished_is_told_and_not_stored_again(finished):
    store, said = finished
    ran = tumble("resume", said["recording"], "--json", "-")
    assert ran.status == 0, ran.err
    assert ran.err == f"{said['recording']} is complete, and record {said['record']} of it exists: nothing was done\n"
    assert json.loads(ran.out) == said
    (listed,) = json.loads(tumble("records", "list", "--store", store, "--json", "-").out)["records"]
    assert listed["revision"] == 1


def test_a_calibration_that_was_cut_off_before_its_report_gets_it_and_no_second_record(finished):
    store, said = finished
    Path(said["report"]).unlink()
    ran = tumble("resume", said["recording"], "--json", "-")
    assert ran.status == 0, ran.err
    assert ran.err.endswith("exists: only its report was missing\n")
    assert Path(json.loads(ran.out)["report"]).is_file()
    assert len(json.loads(tumble("records", "list", "--store", store, "--json", "-").out)["records"]) == 1


def test_a_calibration_that_was_cut_off_before_its_record_gets_one(finished):
    store, said = finished
    (store / "records.sqlite").unlink()
    again = json.loads(tumble("resume", said["recording"], "--json", "-").out)
    assert again["record"] != said["record"]
    assert again["parameters"] == said["parameters"]


def test_a_finished_calibration_outside_its_limits_still_is(programme, tmp_path, write, no_report):
    narrow = write("narrow.toml", TWICE + "\n[limits]\nkx = { min = 2.0, max = 3.0 }\n")
    ran = tumble("calibrate", "--programme", narrow, "--serial", "A", "--store", tmp_path / "store", "--json", "-")
    assert ran.status == 1
    assert tumble("resume", json.loads(ran.out)["recording"]).status == 1


def _moved(path, target):
    shutil.move(path, target)
    return target


def test_a_stand_file_that_was_changed_is_refused_and_nothing_touched(cut, stand, tmp_path):
    _, broken = cut(5, "--stand", stand)
    stand.write_text(STAND + "seed = 2\n", encoding="utf-8")
    ran = tumble("resume", broken)
    assert ran.status == 2
    assert ran.complaint.startswith(f"{stand}: is not the stand file with which {broken} was begun")
    assert not list(tmp_path.glob("run.cut*"))


def test_the_stand_file_may_have_been_moved(cut, stand, tmp_path):
    _, broken = cut(5, "--stand", stand)
    stand.rename(tmp_path / "elsewhere.toml")
    assert tumble("resume", broken).status == 2
    assert tumble("resume", broken, "--stand", tmp_path / "elsewhere.toml").status == 0


def test_a_programme_that_was_altered_in_the_recording_is_refused(cut):
    _, broken = cut(5)
    unfinished = find(broken)
    header = replace(unfinished.recording.header, programme_text=TWICE.replace("60.0", "61.0"))
    altered = replace(unfinished, recording=replace(unfinished.recording, header=header))
    with pytest.raises(Exception, match="its programme is not the one that was begun"):
        _ = altered.programme


def test_a_file_that_is_not_there_is_named(tmp_path):
    ran = tumble("resume", tmp_path / "none.mcap")
    assert ran.status == 2
    assert str(tmp_path / "none.mcap") in ran.complaint


def test_a_stand_that_measures_something_else_ends_with_status_3_and_loses_nothing(cut, monkeypatch):
    whole, broken = cut(8)
    with monkeypatch.context() as patched:
        patched.setattr("tumble.procedures.verification.allowed", lambda *_: 1e-9)
        ran = tumble("resume", broken)
    assert ran.status == 3
    assert "look whether the unit, its mount or its wiring has changed" in ran.complaint
    assert f"8 complete points kept in {broken}" in ran.complaint
    assert tumble("resume", broken).status == 0
    assert measured(read_recording(broken)) == measured(read_recording(whole))


DRIFTING = (
    STAND
    + """\
flicker_v = 2e-5
effects = { backlash = 0.002, bias_drift = 2e-3, scale_drift = 1e-3, bias_temperature = 5e-4, bias_random_walk = 1e-4 }
"""
)


def test_with_drift_backlash_and_flicker_a_resumed_calibration_agrees(cut, write, no_report):
    stand = write("drifting.toml", DRIFTING)
    whole, broken = cut(11, "--stand", stand)
    assert tumble("resume", broken).status == 0
    documents = [json.loads(tumble("fit", path, "--json", "-").out) for path in (whole, broken)]
    for name, expected in documents[0]["parameters"].items():
        if expected["value"] is not None:
            off = documents[1]["parameters"][name]["value"] - expected["value"]
            assert abs(off) < 0.1 * expected["standard_uncertainty"], name


def test_an_attended_stand_goes_on_in_real_time(cut, monkeypatch):
    _, broken = cut(19)
    monkeypatch.setattr("sys.stdin", io.StringIO("face-up\n" * 3))
    slept = []
    monkeypatch.setattr("tumble.drivers.clock.time.sleep", slept.append)
    monkeypatch.setattr("tumble.drivers.clock.time.monotonic", lambda: sum(slept))
    ran = tumble("resume", broken, "--attended")
    assert ran.status == 0, ran.err
    assert 1.0 < sum(slept) < 200.0


def test_a_clock_that_is_released_runs_on_from_where_it_was(monkeypatch):
    now = [100.0]
    monkeypatch.setattr("tumble.drivers.clock.time.monotonic", lambda: now[0])
    monkeypatch.setattr("tumble.drivers.clock.time.sleep", lambda duration_s: now.__setitem__(0, now[0] + duration_s))
    clock = ReleasedClock(wall_start_ns=0)
    clock.sleep(5.0)
    assert (clock.monotonic_s(), now[0]) == (5.0, 100.0)
    clock.release()
    clock.sleep(2.0)
    clock.sleep(-1.0)
    assert (clock.monotonic_s(), now[0], clock.wall_ns()) == (7.0, 102.0, 7 * 10**9)


class RealStand:
    """A stand that lived on by itself, whose wall clock says what a test wants."""

    lived_s = None

    def __init__(self, wall_ns):
        self.stand = self.clock = self
        self.wall_ns = lambda: wall_ns


@pytest.mark.parametrize(("later_s", "counted_s"), [(60.0, 60.0), (-86_400.0, 0.0)], ids=["later", "clock set back"])
def test_at_a_real_stand_the_outage_is_counted_by_the_wall_clock_where_that_rose(cut, later_s, counted_s):
    _, broken = cut(5)
    unfinished = find(broken)
    real = RealStand(unfinished.last.log_time_ns + round(later_s * 1e9))
    assert _elapsed_s(unfinished, real) == pytest.approx(unfinished.elapsed_s + counted_s)
    assert unfinished.elapsed_s >= unfinished.recording.points[-1].time_s
