import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from app_jobs import take_again_once, tumble
from cut_runs import POINTS, measured

from tumble.procedures.events import FinishReason, PointCompleted, PointVerified, RunFinished, RunResumed
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.writer import Recorder

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
