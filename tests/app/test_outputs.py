"""What a command writes: whole or not at all, and over nothing but an earlier result of the same kind."""

import errno
import json
import os
import shutil
import sqlite3
import sys
from contextlib import closing
from pathlib import Path

import pytest
from app_jobs import at_call, raiser, tumble

from tumble.app.exits import Exit, JobError
from tumble.app.files import check_result, replacing, write_text
from tumble.app.kinds import Kind, kind_of, kind_of_file
from tumble.drivers.simulated.head import SimulatedHead
from tumble.procedures.errors import InputError

TABLE = "angle_deg,voltage_V\n" + "".join(f"{angle},{2.5 + 0.1 * (angle % 7)}\n" for angle in range(0, 360, 10))
EXPORTED = "time_s,realisation,procedure,mount,angle_deg,direction,voltage_V,voltage_sd_V,samples\n"
RESULT = '{\n  "schema": "tumble.fit/1",\n  "complete": true\n}\n'
FULL = OSError(errno.ENOSPC, "No space left on device")
posix = pytest.mark.skipif(os.name == "nt", reason="a device of POSIX")


@pytest.fixture
def table(write):
    return write("t.csv", TABLE)


def refused(ran, path, content):
    assert ran.status == 2
    assert ran.complaint.startswith(f"{path}: is there already and is no earlier result of the same kind")
    assert path.read_bytes() == content


def test_a_table_that_is_named_as_output_too_stays(table):
    refused(tumble("fit", table, "--json", table), table, TABLE.encode())


@pytest.mark.parametrize("link", [Path.symlink_to, Path.hardlink_to])
def test_a_table_is_known_under_another_name(table, tmp_path, link):
    other = tmp_path / "out.json"
    link(other, table)

    refused(tumble("fit", table, "--json", other), other, TABLE.encode())


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("stand.toml", b'name = "bench-1"\n'),
        ("driver.py", b"raise SystemExit(0)\n"),
        ("other.json", b'{"schema": "other/1"}\n'),
        ("list.json", b"[1, 2]\n"),
        ("record.json", b'{"content_sha256":"' + b"ab" * 32 + b'","created_at":"2026"}\n'),
        ("record.json", b'{"schema": "tumble.record/2"}\n'),
        ("page.html", b"<!DOCTYPE html>\n<html></html>\n"),
        ("run.bin", b"\x89MCAP0\r\n" + bytes(100)),
        ("export.csv", EXPORTED.encode()),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_result_is_written_over_nothing_else(table, write, name, content):
    there = write(name, content)

    refused(tumble("fit", table, "--json", there), there, content)


def test_a_store_is_not_written_over(table, write, tmp_path):
    there = tmp_path / "records.db"
    with closing(sqlite3.connect(there)) as connection:
        connection.execute("CREATE TABLE store (version INTEGER)")
        connection.commit()
    content = there.read_bytes()

    refused(tumble("fit", table, "--json", there), there, content)
    ran = tumble("fit", table, "--json", tmp_path / "records.sqlite")
    assert (ran.status, (tmp_path / "records.sqlite").exists()) == (2, False)
    assert "has the name of a store" in ran.complaint


@pytest.mark.parametrize("before", [b"", RESULT.encode(), RESULT[:30].encode(), b'{"schema": "tumble.loop/1"}'])
def test_an_earlier_result_is_replaced(table, write, before):
    there = write("out.json", before)

    assert tumble("fit", table, "--json", there).status == 0

    assert json.loads(there.read_text("utf-8"))["schema"] == "tumble.fit/1"


def test_a_result_is_known_again_by_every_command(tiny_recording, tmp_path):
    page, exported, planned = tmp_path / "page.html", tmp_path / "x.csv", tmp_path / "plan.json"
    paper = tmp_path / "page.pdf"
    for _ in range(2):
        assert tumble("export", tiny_recording, "--out", exported).status == 0
        assert tumble("plan", "quick", "--json", planned).status == 0
        assert tumble("report", tiny_recording, "--out", page).status == 0
        assert tumble("report", tiny_recording, "--out", paper).status == 0
    assert [kind_of_file(path) for path in (page, paper, exported, planned)] == [
        Kind.REPORT, Kind.PDF, Kind.TABLE, Kind.RESULT,
    ]  # fmt: skip


def test_a_report_of_the_first_version_is_known():
    begins = (
        b'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        b'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>Calibration of SN-7</title>\n'
    )

    assert kind_of(begins) is Kind.REPORT


def test_an_export_does_not_take_the_place_of_a_table(tiny_recording, table):
    refused(tumble("export", tiny_recording, "--out", table), table, TABLE.encode())


def test_a_report_does_not_take_the_place_of_another_page(table, write):
    page = write("t.html", "<html>mine</html>")

    refused(tumble("report", table), page, b"<html>mine</html>")


def test_a_refused_output_is_known_before_anything_moves(tiny, table, tmp_path, monkeypatch):
    at_call(monkeypatch, SimulatedHead, "start_move", 1, raiser(AssertionError("the head moved")))

    for command in ("run", "calibrate", "close-loop"):
        ran = tumble(command, "--programme", tiny, "--serial", "A", "--store", tmp_path / "s", "--json", table)
        refused(ran, table, TABLE.encode())
    ran = tumble("close-loop", "--serial", "A", "--store", tmp_path / "s", "--report", table)
    refused(ran, table, TABLE.encode())
    assert not (tmp_path / "s").exists()


def test_one_place_for_two_results_is_refused(table, tmp_path):
    ran = tumble("close-loop", table, "--json", tmp_path / "x", "--report", tmp_path / "x")

    assert ran.status == 2
    assert "is wanted for another result of this command too" in ran.err


@pytest.mark.parametrize("what", ["a folder", pytest.param("a device", marks=posix), pytest.param("fifo", marks=posix)])
def test_what_is_no_file_is_not_written(table, tmp_path, what):
    place = Path(os.devnull) if what == "a device" else tmp_path / "place"
    if what == "a folder":
        place.mkdir()
    elif what == "fifo":
        os.mkfifo(place)

    ran = tumble("fit", table, "--json", place)

    assert ran.status == 2
    assert ran.complaint == f"{place}: is no file but a folder or a device; name a file to be written"


def test_a_result_that_is_write_protected_stays(table, write):
    there = write("out.json", RESULT)
    there.chmod(0o444)

    ran = tumble("fit", table, "--json", there)

    assert (ran.status, ran.complaint) == (5, f"{there}: is write-protected; choose another name")
    assert there.read_text() == RESULT


@posix
def test_links_in_a_circle_are_said(table, tmp_path):
    (tmp_path / "a").symlink_to(tmp_path / "b")
    (tmp_path / "b").symlink_to(tmp_path / "a")

    ran = tumble("fit", table, "--json", tmp_path / "a")

    assert ran.status == 5
    assert ran.complaint.startswith(f"{tmp_path / 'a'}: cannot be written (")


def test_what_a_link_leads_to_is_replaced_and_the_link_stays(write, tmp_path):
    there = write("out.json", RESULT)
    (tmp_path / "link").symlink_to(there)

    write_text(tmp_path / "link", '{"schema": "tumble.fit/1"}')

    assert (tmp_path / "link").is_symlink()
    assert there.read_text() == '{"schema": "tumble.fit/1"}'


@pytest.mark.parametrize("name", ["fsync", "replace"])
def test_a_full_disk_leaves_the_earlier_result_and_nothing_else(table, write, tmp_path, monkeypatch, name):
    there = write("out.json", RESULT)
    with monkeypatch.context() as disk:
        disk.setattr(os, name, raiser(FULL))
        ran = tumble("fit", table, "--json", there)

    assert ran.status == 5
    assert ran.err.splitlines()[-1] == (
        f"tumble: {there}: cannot be written (No space left on device); make room or choose another place"
    )
    assert there.read_text() == RESULT
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.json", "t.csv"]


@pytest.mark.parametrize("command", ["fit", "report", "export"])
def test_a_disk_that_is_full_while_it_is_written_leaves_no_half_of_a_result(
    tiny_recording, tmp_path, monkeypatch, command
):
    recording = shutil.copy(tiny_recording, tmp_path / "run.mcap")
    place = tmp_path / "out"
    option = "--json" if command == "fit" else "--out"
    write_some = Path.open

    def full(path, mode="r", *arguments, **named):
        file = write_some(path, mode, *arguments, **named)
        if "w" in mode:
            file.write("half")
            file.flush()
            raise FULL
        return file

    with monkeypatch.context() as disk:
        disk.setattr(Path, "open", full)
        disk.setattr(Path, "write_text", lambda path, text, *_, **__: full(path, "w", encoding="utf-8"))
        ran = tumble(command, recording, option, place)

    assert ran.status == 5
    assert "cannot be written (No space left on device)" in ran.err
    assert [path.name for path in tmp_path.iterdir()] == ["run.mcap"]


def test_an_interrupted_result_leaves_the_earlier_one(write, tmp_path):
    there = write("out.json", RESULT)
    with pytest.raises(KeyboardInterrupt), replacing(there, Kind.RESULT) as begun:
        begun.write_text("half")
        raise KeyboardInterrupt

    assert there.read_text() == RESULT
    assert list(tmp_path.iterdir()) == [there]


def test_a_result_that_another_program_has_open_is_to_be_closed_there(write, monkeypatch):
    there = write("out.json", RESULT)
    monkeypatch.setattr("tumble.app.files.os.replace", raiser(PermissionError(errno.EACCES, "Access is denied")))
    with pytest.raises(JobError, match=r"Access is denied\); close whatever has it open") as told:
        write_text(there, RESULT)

    assert told.value.status is Exit.STORAGE
    assert there.read_text() == RESULT


def test_what_fails_elsewhere_while_a_result_is_written_is_not_blamed_on_the_result(write, tmp_path):
    there = write("out.json", RESULT)
    with pytest.raises(FileNotFoundError, match=r"other\.csv"), replacing(there, Kind.RESULT):
        (tmp_path / "other.csv").read_text()

    assert list(tmp_path.iterdir()) == [there]


def test_a_disk_that_is_full_while_a_result_is_written_is_status_5(write):
    there = write("out.json", RESULT)
    with pytest.raises(JobError, match="make room") as told, replacing(there, Kind.RESULT):
        raise OSError(errno.ENOSPC, "No space left on device")

    assert told.value.status is Exit.STORAGE


def test_a_folder_that_is_a_file_is_found_before_anything_is_done(write):
    with pytest.raises(JobError, match=r"cannot be written \("):
        check_result(write("file", "text") / "out.json", Kind.RESULT)


@pytest.mark.skipif(sys.platform == "win32", reason="modes of POSIX")
def test_a_replaced_result_keeps_its_rights(write):
    there = write("out.json", RESULT)
    there.chmod(0o640)

    write_text(there, RESULT)

    assert there.stat().st_mode & 0o777 == 0o640


def test_text_that_is_no_result_is_written_over_nothing(write):
    with pytest.raises(InputError, match="is written over nothing else"):
        write_text(write("out.json", RESULT), "plain")


@pytest.mark.parametrize("left", [1000, 0], ids=["half", "none"])
def test_a_report_that_an_earlier_version_left_half_is_written_anew(copied, left):
    (report,) = (copied.store / "reports").glob("*.html")
    whole = report.read_bytes()
    report.write_bytes(whole[:left])

    ran = tumble("resume", copied.recording)

    assert ran.status == 0
    assert "only its report was missing" in ran.err
    assert report.read_bytes().rstrip().endswith(b"</html>")
