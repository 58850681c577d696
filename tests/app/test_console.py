import io
import os
import sys

import pytest
from app_jobs import STAND, tumble
from rich.console import Console

from tumble.app.console import results, run_display
from tumble.app.running import Job, run
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.drivers.clock import VirtualClock
from tumble.procedures.events import ReadingAnswered, ReadingRequested
from tumble.procedures.programmes import load_programme


@pytest.fixture
def shown(tiny, tmp_path):
    """What a terminal shows of a run of six dwells."""
    stand = load_stand()
    job = Job(stand=stand, programme=load_programme(tiny), serial_number="A")
    connected = connect(stand)
    terminal = io.StringIO()
    console = Console(file=terminal, force_terminal=True, width=100)
    with run_display(job.plan(), connected.stand.clock, console) as display:
        run(job, connected, tmp_path / "x.mcap", [display])
    return terminal.getvalue()


def test_a_terminal_shows_how_far_a_run_is(shown):
    assert "face-up  300.00°" in shown
    assert "6/6, 00:00 ± 00:00 left" in shown


def test_the_bar_is_taken_away_while_a_question_is_open(tiny):
    job = Job(stand=load_stand(), programme=load_programme(tiny), serial_number="A")
    terminal = io.StringIO()
    with run_display(job.plan(), VirtualClock(), Console(file=terminal, force_terminal=True, width=100)) as display:
        display(ReadingRequested(setting_deg=0.0, prompt="Set the head."))
        taken_away = shows_bar(terminal)
        display(ReadingAnswered(setting_deg=0.0, answer="", reading_deg=0.0))
        assert (taken_away, shows_bar(terminal)) == (False, True)


def shows_bar(terminal):
    """A bar hides the cursor."""
    return terminal.getvalue().rfind("\x1b[?25l") > terminal.getvalue().rfind("\x1b[?25h")


def test_nothing_of_a_run_is_shown_where_there_is_no_terminal(tiny, tmp_path):
    ran = tumble("run", "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    assert ran.err == f"recording {tmp_path / 'x.mcap'}\n"


def test_a_reader_that_leaves_early_is_no_fault(monkeypatch):
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as left:
        monkeypatch.setattr(sys, "stdout", left)
        results().print("seen by nobody")
        results().print("nor is this")


def test_a_warning_of_the_run_is_one_line(write, tiny, tmp_path):
    stand = write("narrow.toml", STAND + "range_v = 3.0\n")

    ran = tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    overload = "10 of 10 samples are overloads or no numbers; the point will be set aside"
    assert f"warning: point 4 (face-up at 240 deg): {overload}" in ran.err.splitlines()


def test_rows_that_are_set_aside_are_shown_with_their_reason(write, tiny, tmp_path):
    stand = write("narrow.toml", STAND + "range_v = 3.0\n")
    tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    lines = tumble("fit", tmp_path / "x.mcap").out.splitlines()

    assert any(line.startswith("4 of 6 rows used") for line in lines)
    assert [line[:8] for line in lines if line.startswith("  row ")] == ["  row 5:", "  row 6:"]
