import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from app_jobs import raiser, tumble

from tumble.app import shared_lock_files
from tumble.app.exits import Exit, JobError
from tumble.app.running import Job, run
from tumble.app.stand import load_stand
from tumble.app.stand_lock import holding, holding_recording
from tumble.app.wiring import connect
from tumble.procedures.events import PointCompleted
from tumble.procedures.programmes import load_programme
from tumble.procedures.recording.reader import read_recording

OTHER = """\
import sys
from pathlib import Path
from tumble.app.stand import load_stand
from tumble.app.stand_lock import holding
with holding(load_stand(Path(sys.argv[1])), "SN-9"):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def locks(tmp_path, monkeypatch):
    """A folder for all users in which no lock is anybody else's."""
    folder = tmp_path / "locks"
    folder.mkdir()
    folder.chmod(0o1777)
    monkeypatch.setattr(shared_lock_files, "FOLDERS", (str(tmp_path / "none"), str(tmp_path), str(folder)))
    return folder


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
        refused(stand, f"process {os.getpid()} on .*, which measures A since")


def test_what_a_dead_process_left_is_taken_over(locks, stand):
    with holding(load_stand(stand), "A"):
        (lock,) = locks.iterdir()
        left = lock.read_bytes()
    lock.write_bytes(left)
    with holding(load_stand(stand), "B"):
        assert json.loads(lock.read_text())["serial_number"] == "B"


def test_a_lock_that_was_given_back_leaves_no_file(locks, stand):
    with holding(load_stand(stand), "A"):
        refused(stand, f"process {os.getpid()} on")
    assert list(locks.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="ProgramData has access lists")
def test_a_lock_is_open_to_all_users_whatever_the_mask(locks, stand):
    mask = os.umask(0o077)
    try:
        with holding(load_stand(stand), "A"):
            (lock,) = locks.iterdir()
            assert lock.stat().st_mode & 0o777 == 0o666
    finally:
        os.umask(mask)


def put_link(lock, elsewhere):
    elsewhere.write_text("precious")
    lock.symlink_to(elsewhere)


def put_second_name(lock, elsewhere):
    elsewhere.write_text("precious")
    lock.hardlink_to(elsewhere)


def put_folder(lock, _elsewhere):
    lock.mkdir()


def put_pipe(lock, _elsewhere):
    os.mkfifo(lock)


@pytest.mark.skipif(sys.platform == "win32", reason="ProgramData has access lists")
@pytest.mark.parametrize("put", [put_link, put_second_name, put_folder, put_pipe])
def test_what_somebody_put_in_the_place_of_a_lock_is_told_and_no_way_round_it(locks, stand, tmp_path, put):
    with holding(load_stand(stand), "A"):
        (lock,) = locks.iterdir()
    elsewhere = tmp_path / "elsewhere"
    put(lock, elsewhere)
    refused(stand, rf"the stand at .* cannot be had to oneself: {lock}, where all users lock it, cannot be used")
    assert not elsewhere.exists() or elsewhere.read_text() == "precious"


@pytest.mark.parametrize("words", ["{", "[" * 1900, "[]", '"x"', "\0"])
def test_what_somebody_wrote_into_a_lock_is_not_believed(locks, stand, words):
    with holding(load_stand(stand), "A"):
        (lock,) = locks.iterdir()
        lock.write_text(words)
        refused(stand, "is in use by another process; wait until it is done, or stop it")


def test_two_stand_files_with_the_same_instrument_are_one_stand(write):
    head = '[head]\ndriver = "zaber"\nurl = "COM7"\nlimits_deg = [0, 90]\n'
    text = f'name = "x"\n{head}[daq]\ndriver = "scpi"\nurl = "COM8"\n'
    first, second = write("first.toml", text), write("second.toml", text.replace("COM8", "COM9"))
    with holding(load_stand(first), "A"):
        refused(second, "the stand at COM7 is in use by process")


def test_the_stand_that_is_built_in_is_everybodys(locks):
    with holding(load_stand(), "A"), holding(load_stand(), "B"):
        assert list(locks.iterdir()) == []


@pytest.mark.parametrize("home", ["file", "absent"])
def test_it_takes_no_home_to_lock_a_stand(locks, stand, tmp_path, monkeypatch, home):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / home))
    monkeypatch.setenv("TMPDIR", str(tmp_path / home))
    with holding(load_stand(stand), "A"):
        assert len(list(locks.iterdir())) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="ProgramData is there")
def test_without_a_folder_for_all_users_no_lock_is_taken_for_one(stand, tmp_path, monkeypatch):
    monkeypatch.setattr(shared_lock_files, "FOLDERS", (str(tmp_path),))
    refused(stand, "is a folder that all users may write to")


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


def test_a_recording_that_somebody_else_has_is_not_begun(tiny, tmp_path):
    recording = tmp_path / "x.mcap"
    job = Job(stand=load_stand(), programme=load_programme(tiny), serial_number="A")
    with holding_recording(recording, "B"), pytest.raises(JobError, match="is in use by process"):
        run(job, connect(job.stand), recording)

    assert not recording.exists()


def test_a_folder_of_locks_that_the_system_refuses_is_told_with_the_stand(stand, monkeypatch):
    monkeypatch.setattr(
        "tumble.app.stand_lock.lock_folder",
        raiser(PermissionError(13, "Access is denied", "C:/ProgramData/tumble/locks")),
    )
    with pytest.raises(JobError, match=r"C:/ProgramData/tumble/locks, .* \(Access is denied\)") as told:
        holding(load_stand(stand), "A").__enter__()

    assert told.value.status is Exit.DEVICE_FAULT
