"""`tumble control`."""

import threading
from contextlib import ExitStack, contextmanager

import pytest
from app_jobs import tumble

from tumble.app.control_file import ControlFile


@contextmanager
def hearing(recording):
    """Take what a run is told, each within a moment; yields the lines."""
    file = ControlFile(recording)
    recording.parent.mkdir(parents=True, exist_ok=True)
    file.open()
    lines, over = [], threading.Event()

    def listen():
        while not over.wait(0.01):
            lines.extend(file.taken())

    ear = threading.Thread(target=listen)
    ear.start()
    try:
        yield lines
    finally:
        over.set()
        ear.join()


class TestTheCommand:
    """`tumble control`."""

    @pytest.fixture
    def runs(self, tmp_path):
        """Begins to listen for the run of a recording in a store; returns the list of what that hears."""
        with ExitStack() as stack:
            yield lambda name: stack.enter_context(hearing(tmp_path / "recordings" / "SN1" / name))

    @pytest.fixture
    def heard(self, runs):
        return runs("a.mcap")

    def test_tells_the_only_run_of_a_store(self, heard, tmp_path):
        assert tumble("control", "pause", "--store", tmp_path).status == 0
        assert tumble("control", "continue", "--store", tmp_path).status == 0
        assert heard == ["pause 60", "continue"]

    def test_tells_the_run_of_a_recording_how_long_a_pause_may_last(self, heard, tmp_path):
        told = tumble("control", "pause", tmp_path / "recordings" / "SN1" / "a.mcap", "--at-most", "5")
        assert (told.status, heard) == (0, ["pause 5"])

    def test_says_where_nobody_hears(self, tmp_path, monkeypatch):
        monkeypatch.setattr("tumble.app.commands.control.PATIENCE_S", 0.1)
        for there in (False, True):
            file = ControlFile(tmp_path / "x.mcap")
            if there:
                file.open()  # of a run that was killed
            told = tumble("control", "stop", tmp_path / "x.mcap")
            assert told.status == 2
            assert "no run of the command line hears there" in told.complaint
            assert not file.path.exists()

    def test_says_where_no_run_is_under_way_and_where_several_are(self, heard, runs, tmp_path):
        assert "no run is under way there" in tumble("control", "stop", "--store", tmp_path / "other").complaint
        also_heard = runs("b.mcap")
        assert "several runs are under way" in tumble("control", "stop", "--store", tmp_path).complaint
        assert [line for line in heard + also_heard if line] == []

    def test_tells_the_only_run_that_hears_where_others_were_killed(self, heard, tmp_path, monkeypatch):
        monkeypatch.setattr("tumble.app.commands.control.PATIENCE_S", 0.5)
        killed = ControlFile(tmp_path / "recordings" / "SN1" / "killed.mcap")
        killed.open()
        killed.path.write_text("pause\n")
        assert tumble("control", "stop", "--store", tmp_path).status == 0
        assert heard[-1] == "stop"
        assert not killed.path.exists()
