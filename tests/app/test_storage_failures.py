import errno
from pathlib import Path

import pytest
from app_jobs import at_call, raiser, tumble
from mcap.writer import Writer

from tumble.app.exits import Exit, JobError
from tumble.drivers.simulated.head import SimulatedHead
from tumble.procedures.recording.reader import read_recording

FULL = OSError(errno.ENOSPC, "No space left on device")
OPEN = Path.open
READ_ONLY = OSError(errno.EROFS, "Read-only file system")


def test_a_full_disk_ends_the_run_and_keeps_the_points_before(tiny, tmp_path, monkeypatch):
    recording = tmp_path / "x.mcap"
    # Header and the operator's answer are put on the disk before the first point.
    with monkeypatch.context() as disk:
        at_call(disk, Writer, "flush", 2 + 4, raiser(FULL))
        ran = tumble("run", "--programme", tiny, "--serial", "A", "--out", recording)

    assert ran.status == 5
    assert ran.complaint == (
        f"the recording failed: {recording}: cannot be written (No space left on device); make sure that the folder "
        f"exists, is writable and has room; then resume the run; 3 complete points kept in {recording}"
    )
    kept = read_recording(recording)
    assert [point.positions_deg["head"] for point in kept.points] == [0.0, 60.0, 120.0]
    assert not kept.closed
    assert tumble("fit", recording).status == 0


def test_a_disk_that_is_full_when_the_recording_is_closed_loses_no_point(tiny, tmp_path, monkeypatch):
    recording = tmp_path / "x.mcap"
    with monkeypatch.context() as disk:
        disk.setattr(Writer, "finish", raiser(FULL))
        ran = tumble("run", "--programme", tiny, "--serial", "A", "--out", recording)

    assert ran.status == 5
    assert ran.complaint.startswith(f"{recording}: cannot be written (No space left on device)")
    assert ran.complaint.endswith("its complete points can be read")
    assert len(read_recording(recording).points) == 6


def open_but_make_nothing(path, mode="r", *arguments, **named):
    if "x" in mode:
        raise READ_ONLY
    return OPEN(path, mode, *arguments, **named)


@pytest.mark.parametrize("command", ["run", "calibrate"])
@pytest.mark.parametrize(
    ("name", "replacement"), [("mkdir", raiser(READ_ONLY)), ("open", open_but_make_nothing)], ids=["folder", "file"]
)
def test_a_read_only_store_is_found_before_anything_moves(tiny, tmp_path, monkeypatch, command, name, replacement):
    at_call(monkeypatch, SimulatedHead, "start_move", 1, raiser(AssertionError("the head moved")))
    with monkeypatch.context() as disk:
        disk.setattr(Path, name, replacement)
        ran = tumble(command, "--programme", tiny, "--serial", "A", "--store", tmp_path / "s")

    assert ran.status == 5
    assert ran.complaint.startswith(str(tmp_path / "s"))
    assert "read-only file system" in ran.complaint.lower()


def test_a_store_that_cannot_be_a_folder_is_status_5(tiny, write):
    ran = tumble("run", "--programme", tiny, "--serial", "A", "--store", write("file", "text"))

    assert ran.status == 5
    assert "cannot be created (" in ran.complaint


def test_a_record_that_cannot_be_stored_leaves_the_recording(write, tmp_path, tiny_recording):
    (tmp_path / "s").mkdir()
    write("s/records.sqlite", b"this is no database" * 100)

    ran = tumble("fit", tiny_recording, "--store", tmp_path / "s")

    assert ran.status == 5
    assert ran.complaint == (
        f"{tmp_path / 's' / 'records.sqlite'}: this is not a database; move the file away, or choose another store; "
        f"the recording is kept in {tiny_recording}"
    )
    assert read_recording(tiny_recording).complete


@pytest.mark.parametrize("name", ["records.sqlite", "reports"])
def test_a_store_that_would_not_take_the_result_is_found_before_anything_is_measured(write, tiny, tmp_path, name):
    (tmp_path / "s").mkdir()
    write(f"s/{name}", b"this is no database" * 100)

    ran = tumble("calibrate", "--programme", tiny, "--serial", "A", "--store", tmp_path / "s")

    assert ran.status == 5
    assert ran.complaint.endswith("nothing was measured")
    assert not (tmp_path / "s" / "recordings").exists()


def test_a_report_that_cannot_be_written_leaves_record_and_recording(tiny, tmp_path, no_report, monkeypatch):
    def full(path, _text):
        raise JobError(f"{path}: cannot be written (No space left on device)", Exit.STORAGE)

    monkeypatch.setattr("tumble.app.reports.write_text", full)
    ran = tumble("calibrate", "--programme", tiny, "--serial", "A", "--store", tmp_path / "s")

    (recording,) = (tmp_path / "s").glob("recordings/A/*.mcap")
    assert ran.status == 5
    assert ran.complaint.startswith(str(tmp_path / "s" / "reports"))
    assert f"of {recording} is stored" in ran.complaint
    assert tumble("records", "verify", "--store", tmp_path / "s").status == 0


@pytest.mark.parametrize(
    "arguments",
    [
        ("fit", "RECORDING", "--json", "FILE/out"),
        ("export", "RECORDING", "--out", "FILE/out"),
        ("report", "RECORDING", "--out", "FILE/out"),
        ("plan", "quick", "--json", "FILE/out"),
    ],
    ids=lambda arguments: arguments[0],
)
def test_a_result_that_cannot_be_written_is_status_5(write, tiny_recording, no_report, arguments):
    file = write("file", "text")
    places = {"RECORDING": str(tiny_recording), "FILE/out": str(file / "out")}

    ran = tumble(*(places.get(argument, argument) for argument in arguments))

    assert ran.status == 5
    assert ran.complaint.startswith(f"{file / 'out'}: cannot be written (")
