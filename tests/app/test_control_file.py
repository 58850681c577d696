"""The file by which a run is told: what else may stand at its name, who else may write, and a run that is over."""

import errno
import os
import sys
import threading
import time
from unittest.mock import Mock

import pytest
from app_jobs import tumble

from tumble.app.control_file import ControlFile

needs_links = pytest.mark.skipif(sys.platform == "win32", reason="Windows has links for administrators only")


@pytest.fixture
def file(tmp_path):
    return ControlFile(tmp_path / "x.mcap")


@pytest.fixture
def another(tmp_path):
    """A file of somebody who wants nothing of the run."""
    path = tmp_path / "keys"
    path.write_text("stop\n")
    return path


def link_to(another, file):
    file.path.symlink_to(another)


def second_name_of(another, file):
    os.link(another, file.path)


@needs_links
@pytest.mark.parametrize("name_it", [link_to, second_name_of])
def test_what_has_another_name_too_is_not_emptied_at_the_beginning(file, another, name_it):
    name_it(another, file)
    with pytest.raises(FileExistsError):
        file.open()
    assert another.read_text() == "stop\n"


@needs_links
@pytest.mark.parametrize("name_it", [link_to, second_name_of])
def test_nor_while_the_run_goes_on(file, another, name_it):
    file.open()
    file.path.unlink()
    name_it(another, file)
    with pytest.raises(FileExistsError):
        file.taken()
    assert another.read_text() == "stop\n"


@needs_links
def test_a_link_to_nothing_has_nothing_made(file, tmp_path):
    file.path.symlink_to(tmp_path / "nothing")
    with pytest.raises(FileExistsError):
        file.open()
    assert not (tmp_path / "nothing").exists()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows has no such pipes in a folder")
def test_a_pipe_at_its_name_does_not_hold_the_run_up(file):
    os.mkfifo(file.path)
    with pytest.raises(FileExistsError):
        file.open()


def test_a_folder_in_which_nothing_can_be_locked_is_told_of_at_the_beginning(file, monkeypatch):
    monkeypatch.setattr("tumble.app.plain_files.lock", Mock(side_effect=OSError(errno.ENOLCK, "No locks available")))
    with pytest.raises(OSError, match="No locks available"):
        file.open()


def test_a_note_that_begins_like_a_wish_is_left_alone(file):
    file.path.write_text("stop the chamber on Friday\n")
    with pytest.raises(FileExistsError):
        file.open()
    assert file.path.read_text() == "stop the chamber on Friday\n"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows takes no file away that another has open")
@pytest.mark.parametrize("drop", [ControlFile.close, ControlFile.open])
def test_a_wish_is_not_heard_where_the_run_ends_before_it_looks_or_the_next_begins(file, drop):
    file.open()
    heard = []
    teller = threading.Thread(target=lambda: heard.append(file.tell("again", 5.0)))
    teller.start()
    deadline_s = time.monotonic() + 5.0
    while not file.path.stat().st_size:
        assert time.monotonic() < deadline_s
        time.sleep(0.01)
    drop(file)
    teller.join()
    assert heard == [False]


def test_a_wish_does_not_mix_with_the_unfinished_line_of_another(file):
    file.open()
    file.path.write_text("paus")
    taken = []
    teller = threading.Thread(target=file.tell, args=("stop", 5.0))
    teller.start()
    while teller.is_alive():
        taken += file.taken()
        time.sleep(0.01)
    assert taken == ["paus", "stop"]


def test_a_line_without_an_end_is_one_once_nothing_follows(file):
    file.open()
    file.path.write_text("stop")
    assert (file.taken(), file.taken()) == ([], ["stop"])


def test_the_last_of_too_many_lines_is_taken(file):
    file.open()
    file.path.write_text("x" * 9000 + "\nstop\n")
    assert file.taken()[-1] == "stop"


def test_what_windows_powershell_writes_is_understood(file):
    file.open()
    file.path.write_bytes(b"\xff\xfe" + "stop\r\n".encode("utf-16-le"))
    assert file.taken() == ["stop"]


def test_two_who_write_at_once_are_both_heard(file):
    file.open()
    heard, taken = [], []
    tellers = [threading.Thread(target=lambda: heard.append(file.tell("again", 5.0))) for _ in range(8)]
    for teller in tellers:
        teller.start()
    while any(teller.is_alive() for teller in tellers):
        taken += file.taken()
    assert (taken, heard) == (["again"] * 8, [True] * 8)


def test_the_command_says_where_it_may_not_write(file, monkeypatch):
    refused = PermissionError(errno.EACCES, "Permission denied", str(file.path))
    monkeypatch.setattr("tumble.app.control_file.open_plain", Mock(side_effect=refused))
    told = tumble("control", "stop", file.path.with_suffix(".mcap"))
    assert (told.status, "(Permission denied)" in told.complaint) == (2, True)


@pytest.mark.parametrize("name", [".", "notes.txt", "tumble-store"])
def test_the_command_says_what_is_no_recording(name):
    told = tumble("control", "stop", name)
    assert (told.status, "is no name of a recording" in told.complaint) == (2, True)


def test_the_command_says_what_is_a_folder(file):
    file.path.mkdir()
    told = tumble("control", "stop", file.path.with_suffix(".mcap"))
    assert (told.status, "is no control file of a run" in told.complaint) == (2, True)
