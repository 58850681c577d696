"""What is wanted of a run that no window watches: typed at its terminal, or told by `tumble control`."""

import errno
import io
import os
import signal
import sys
import threading
import time
from dataclasses import replace
from functools import partial
from unittest.mock import Mock

import pytest
from app_jobs import tumble

from tumble.app.control_file import ControlFile
from tumble.app.listening import LOOK_S, listening, typed_here
from tumble.app.patience import PatientControl
from tumble.app.running import Job, run
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.procedures.control import Control
from tumble.procedures.events import (
    FinishReason,
    PointCompleted,
    State,
    StateChanged,
)
from tumble.procedures.programmes import load_programme
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.typed import Typed


class Keyboard:
    """A terminal at which lines are typed when a test wants it."""

    def __init__(self):
        self.lines, self.more = [], threading.Event()

    def isatty(self):
        return True

    def type(self, line):
        self.lines.append(f"{line}\n")
        self.more.set()

    def __iter__(self):
        while True:
            self.more.wait()
            self.more.clear()
            yield from self.lines
            self.lines.clear()


class Run:
    """A run of six points on the simulated stand, in a thread of its own or in that of the test."""

    def __init__(self, programme, recording, lines):
        self.job = Job(stand=load_stand(), programme=load_programme(programme), serial_number="A")
        self.recording = recording
        self.control = PatientControl()
        self.file = ControlFile(recording)
        self.events = []
        self.at = {}
        self.lines = lines

    def __call__(self):
        hears = partial(listening, Typed(self.lines))
        connected = replace(connect(self.job.stand), control=self.control, hears=hears)
        return run(self.job, connected, self.recording, [self.hear])

    def hear(self, event):
        self.events.append(event)
        if isinstance(event, PointCompleted):
            self.at.pop(event.point.index, lambda: None)()
        if event == StateChanged(state=State.PAUSED):
            self.at.pop("paused", lambda: None)()

    def told(self, line):
        """Have it said in the control file, and wait until it was heard, as somebody else would."""
        assert self.file.tell(line, 10.0)

    @property
    def paused(self):
        return StateChanged(state=State.PAUSED) in self.events


@pytest.fixture
def keyboard():
    return Keyboard()


@pytest.fixture
def at_a_terminal(tiny, tmp_path, keyboard):
    return Run(tiny, tmp_path / "x.mcap", keyboard)


@pytest.fixture
def unattended(tiny, tmp_path):
    return Run(tiny, tmp_path / "x.mcap", io.StringIO("pause\nstop\n"))


def later(do):
    """Do something in a thread, which the run does not wait for."""
    return lambda: threading.Thread(target=do, daemon=True).start()


def until(holds):
    deadline_s = time.monotonic() + 10.0
    while not holds():
        assert time.monotonic() < deadline_s
        time.sleep(0.01)


def typed(run, keyboard, line, holds):
    """Type a line, and go on once it was understood."""

    def do():
        keyboard.type(line)
        until(lambda: holds(run.control))

    return do


def test_a_run_at_a_terminal_pauses_and_goes_on_as_is_typed(at_a_terminal, keyboard):
    at_a_terminal.at = {
        2: typed(at_a_terminal, keyboard, "pause", Control.pause_wanted),
        "paused": partial(keyboard.type, "continue"),
    }
    assert at_a_terminal().reason is FinishReason.COMPLETED
    assert at_a_terminal.paused


def test_it_takes_the_last_point_again_as_is_typed(at_a_terminal, keyboard):
    at_a_terminal.at = {2: typed(at_a_terminal, keyboard, "Again", lambda control: control._again)}
    assert [point.take for point in at_a_terminal().points] == [1, 1, 2, 1, 1, 1]


def test_it_stops_as_is_typed(at_a_terminal, keyboard):
    at_a_terminal.at = {2: typed(at_a_terminal, keyboard, "stopp", Control.stop_wanted)}
    outcome = at_a_terminal()
    assert (outcome.reason, len(outcome.points), outcome.at_standstill) == (FinishReason.STOPPED, 3, True)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows halts nothing that reads in the background")
def test_reading_its_terminal_in_the_background_does_not_halt_it(at_a_terminal):
    before = signal.signal(signal.SIGTTIN, signal.SIG_DFL)
    try:
        at_a_terminal()
        assert signal.getsignal(signal.SIGTTIN) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGTTIN, before)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such terminals")
def test_a_terminal_is_heard_on_after_what_is_no_text(monkeypatch):
    there, here = os.openpty()
    with os.fdopen(here, encoding="utf-8") as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        typed = typed_here()
        typed.begin()
        os.write(there, b"\xff\nstop\n")
        lines = []
        until(lambda: lines.append(typed.next()) or "stop\n" in lines or typed.at_end)
        assert "stop\n" in lines
        os.close(there)
        until(lambda: typed.next() is None and typed.at_end)


def test_what_comes_through_a_pipe_is_no_wish(unattended):
    assert unattended().reason is FinishReason.COMPLETED
    assert not unattended.paused


def test_an_unattended_run_pauses_and_goes_on_as_it_is_told(unattended):
    unattended.at = {
        2: partial(unattended.told, "pause"),
        "paused": later(partial(unattended.told, "continue")),
    }
    assert unattended().reason is FinishReason.COMPLETED
    assert unattended.paused


def test_it_takes_the_last_point_again_as_it_is_told(unattended):
    unattended.at = {3: partial(unattended.told, "again")}
    assert [point.take for point in unattended().points] == [1, 1, 1, 2, 1, 1]
    assert [point.take for point in read_recording(unattended.recording).points] == [1, 1, 1, 2, 1, 1]


def test_a_pause_that_nobody_ends_is_ended_with_the_run(unattended):
    unattended.at = {2: partial(unattended.told, "pause 0.001")}
    outcome = unattended()
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STOPPED, True)
    assert outcome.message == "the run was paused for 0.001 min"


def test_the_control_file_is_there_as_long_as_the_run(unattended):
    unattended.at = {2: lambda: until(unattended.file.path.exists)}
    unattended.file.path.write_text("stop\n")  # of a run before
    assert unattended().reason is FinishReason.COMPLETED
    assert not unattended.file.path.exists()


def test_what_else_has_its_name_is_left_alone(unattended, capsys, monkeypatch):
    monkeypatch.setattr("tumble.app.commands.control.PATIENCE_S", 0.1)
    unattended.file.path.write_text("of the lab's own\n")
    unattended.at = {2: partial(time.sleep, 2 * LOOK_S)}
    assert unattended().reason is FinishReason.COMPLETED
    assert unattended.file.path.read_text() == "of the lab's own\n"
    assert "the run cannot be told anything by it (it is no control file of a run)" in capsys.readouterr().err
    assert tumble("control", "stop", unattended.recording).status == 2
    assert unattended.file.path.read_text() == "of the lab's own\n"


def test_a_run_whose_control_file_is_taken_away_goes_on(unattended):
    unattended.at = {2: unattended.file.path.unlink}
    assert unattended().reason is FinishReason.COMPLETED


def test_an_empty_line_only_asks_whether_somebody_hears(unattended, capsys):
    unattended.at = {2: partial(unattended.told, "")}
    assert unattended().reason is FinishReason.COMPLETED
    assert capsys.readouterr().err == ""


def test_what_cannot_be_said_keeps_no_wish_from_being_heeded(unattended, monkeypatch):
    monkeypatch.setattr("tumble.app.listening.say", Mock(side_effect=OSError(errno.ENOSPC, "no space")))
    unattended.at = {2: partial(unattended.told, "dance\nstop")}
    assert unattended().reason is FinishReason.STOPPED


def test_a_run_whose_control_file_was_taken_away_can_be_told_again(unattended):
    def take_away():
        until(unattended.file.path.exists)
        unattended.file.path.unlink()
        until(unattended.file.path.exists)
        unattended.told("stop")

    unattended.at = {2: take_away}
    assert unattended().reason is FinishReason.STOPPED
