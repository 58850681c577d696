"""What another user wrote is not read, and no link is followed."""

import os
import sys

import pytest

from tumble.drivers.private_files import private_folder, read_private, write_private
from tumble.drivers.processes import started

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="access lists of the user's folder do it there")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return private_folder("emulated")


def test_folder_and_file_are_closed_to_others(folder):
    folder.chmod(0o755)
    write_private(folder / "a", "text")
    assert private_folder("emulated").stat().st_mode & 0o777 == 0o700
    assert (folder / "a").stat().st_mode & 0o777 == 0o600
    assert read_private(folder / "a") == "text"


def test_a_link_is_neither_read_nor_written_through(folder, tmp_path):
    precious = tmp_path / "precious"
    precious.write_text("precious")
    precious.chmod(0o600)
    (folder / "a").symlink_to(precious)
    with pytest.raises(OSError, match="symbolic links"):
        read_private(folder / "a")
    write_private(folder / "a", "text")
    assert precious.read_text() == "precious"


def test_a_folder_that_is_a_link_is_refused(folder, tmp_path):
    folder.rmdir()
    (tmp_path / "elsewhere").mkdir()
    folder.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(PermissionError, match="is a link, or another user's"):
        private_folder("emulated")


def test_a_file_that_others_may_write_is_refused(folder):
    write_private(folder / "a", "text")
    (folder / "a").chmod(0o606)
    with pytest.raises(PermissionError):
        read_private(folder / "a")


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() != 0, reason="only root gives files away")
def test_a_file_of_another_user_is_refused(folder):
    write_private(folder / "a", "text")
    os.chown(folder / "a", 65534, 65534)
    with pytest.raises(PermissionError):
        read_private(folder / "a")


def test_a_process_is_known_by_its_beginning():
    assert started(os.getpid()) == started(os.getpid()) != ""
    assert started(2**22 + 1) == ""
