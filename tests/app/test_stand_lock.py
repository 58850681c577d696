import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from app_jobs import tumble

from app.exits import JobError
from app.running import Job, run
from app.stand import load_stand
from app.stand_lock import holding, state_folder
from app.wiring import connect
from procedures.events import PointCompleted
from procedures.programme import load_programme
from procedures.recording.reader import read_recording

OTHER = """\
import sys
from pathlib import Path
from app.stand import load_stand
from app.stand_lock import holding
with holding(load_stand(Path(sys.argv[1])), "SN-9"):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture(autouse=True)
def own_state(tmp_path, monkeypatch):
    """No lock of these tests is anybody else's."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path / "state"))


@pytest.fixture
def other(stand):
    """Another process that has the stand."""
    process = subprocess.Popen(
        [sys.executable, "-c", OTHER, str(stand)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=Path.cwd()
    )
    with process:
        assert process.stdout.readline().strip() == b"held"
        yield process
        process.kill()


def refused(stand, sentence):
    """Make sure that the stand cannot be had now."""
    with pytest.raises(JobError, match=sentence), holding(load_stand(stand), "B"):
        pass


def test_a_second_process_is_refused_with_the_name_of_the_first(other, stand, tiny, tmp_path):
    ran = tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")
    assert ran.status == 3
    assert ran.complaint.startswith(f"the stand at {stand.resolve()} is in use by process {other.pid} on ")
    assert ", which measures SN-9 since 20" in ran.complaint
    assert not (tmp_path / "x.mcap").exists()


def test_the_lock_of_a_dead_process_is_taken_over(other, stand):
    other.kill()
    other.wait(10.0)
    with holding(load_stand(stand), "A"):
        (lock,) = (state_folder() / "stands").iterdir()
        held = json.loads(lock.read_text())
        assert (held["pid"], held["serial_number"]) == (os.getpid(), "A")


def test_a_lock_that_was_given_back_leaves_no_file(stand):
    with holding(load_stand(stand), "A"):
        refused(stand, f"process {os.getpid()} on")
    assert list((state_folder() / "stands").iterdir()) == []


def test_two_stand_files_with_the_same_instrument_are_one_stand(write):
    head = '[head]\ndriver = "zaber"\nurl = "COM7"\nlimits_deg = [0, 90]\n'
    text = f'name = "x"\n{head}[daq]\ndriver = "scpi"\nurl = "COM8"\n'
    first, second = write("first.toml", text), write("second.toml", text.replace("COM8", "COM9"))
    with holding(load_stand(first), "A"):
        refused(second, "the stand at COM7 is in use by process")


def test_the_stand_that_is_built_in_is_everybodys():
    with holding(load_stand(), "A"), holding(load_stand(), "B"):
        assert not state_folder().exists()


def test_without_a_home_the_lock_lies_in_the_temporary_folder(stand, tmp_path, monkeypatch):
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("XDG_STATE_HOME", str(blocked))
    monkeypatch.setenv("LOCALAPPDATA", str(blocked))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with holding(load_stand(stand), "A"):
        assert len(list((tmp_path / "tumble-stands").iterdir())) == 1


def test_a_lock_whose_words_cannot_be_read_is_still_one(stand):
    with holding(load_stand(stand), "A"):
        (lock,) = (state_folder() / "stands").iterdir()
        lock.write_text("{")
        refused(stand, "is in use by another process; wait until it is done, or stop it")


def test_instruments_at_the_same_place_by_other_names_are_one_stand(write):
    text = 'name = "a"\n[head]\ndriver = "zaber"\nurl = "{}"\nlimits_deg = [0.0, 1.0]\n'
    text += '[daq]\ndriver = "can"\nurl = "{}"\n'
    one = write("one.toml", text.format("socket://localhost:7001", "socketcan:can0"))
    other = write("other.toml", text.format("rfc2217://127.0.0.1:7001", "socketcan:can1"))
    third = write("third.toml", text.format("COM7", "socketcan:can0?fd=0"))
    with holding(load_stand(one), "A"):
        refused(other, "the stand at rfc2217://127.0.0.1:7001 is in use by process")
        refused(third, r"the stand at socketcan:can0\?fd=0 is in use by process")


def test_a_run_that_is_going_on_is_not_resumed(tiny, tmp_path):
    recording = tmp_path / "x.mcap"
    job = Job(stand=load_stand(), programme=load_programme(tiny), serial_number="A")
    attempts = []

    def resume_now(event):
        if isinstance(event, PointCompleted) and event.point.index == 2:
            attempts.append(tumble("resume", recording))

    run(job, connect(job.stand), recording, [resume_now])

    (attempt,) = attempts
    assert attempt.status == 3
    assert attempt.complaint.startswith(f"the recording {recording} is in use by process {os.getpid()} on ")
    assert read_recording(recording).complete
    assert [path.name for path in tmp_path.glob("*.mcap")] == ["x.mcap"]
