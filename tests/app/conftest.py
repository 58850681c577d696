"""Fixtures of the application's tests."""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

import pytest
from app_jobs import STAND, TINY, Ran, blank_figures, cheaply, few_trials_of, tracing_once, tumble
from cut_runs import TWICE

from tumble.calibrations.methods.dividing_head import analysis
from tumble.procedures.events import PointCompleted
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.recording.writer import Recorder


@dataclass(frozen=True, kw_only=True)
class Done:
    """A store with one calibration in it."""

    ran: Ran
    store: Path
    document: dict

    @property
    def recording(self):
        return next(self.store.glob("recordings/SN-7/*.mcap"))


@pytest.fixture(scope="session")
def calibrated(tmp_path_factory):
    """`tumble calibrate` on the built-in stand, to be looked at only; nobody looks at the figures of its report."""
    folder = tmp_path_factory.mktemp("calibrated")
    with cheaply(blank="figures"), tracing_once():
        ran = tumble(
            "calibrate", "--programme", "quick", "--serial", "SN-7", "--lot", "L 26/3",
            "--operator", "Оксана",
            "--store", folder / "store", "--json", folder / "fit.json",
        )  # fmt: skip
    assert ran.status == 0, ran.err
    return Done(ran=ran, store=folder / "store", document=json.loads((folder / "fit.json").read_text("utf-8")))


@pytest.fixture(scope="module", autouse=True)
def few_trials():
    """Monte Carlo takes most of the time of a fit; how well it does is tested elsewhere."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(analysis, "monte_carlo", few_trials_of(analysis.monte_carlo))
        yield


@pytest.fixture(scope="module", autouse=True)
def traced_once():
    """Rows that several runs of `tumble` have in common are traced by the first of them."""
    with tracing_once():
        yield


@pytest.fixture(scope="module", autouse=True)
def figures():
    """Nobody looks at the figures of a report; a file where somebody does has a fixture of this name of its own."""
    with blank_figures():
        yield


@pytest.fixture
def copied(calibrated, tmp_path):
    """The same at another place, to be changed."""
    shutil.copytree(calibrated.store, tmp_path / "copied")
    return Done(ran=calibrated.ran, store=tmp_path / "copied", document=calibrated.document)


@pytest.fixture
def write(tmp_path):
    """Writes a file and returns its path."""

    def write_file(name, text):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write_file


@pytest.fixture
def tiny(write):
    """Programme of six dwells."""
    return write("tiny.toml", TINY)


@pytest.fixture
def stand(write):
    """Stand file like the one that is built in."""
    return write("bench-1.toml", STAND)


@pytest.fixture(scope="session")
def tiny_recording(tmp_path_factory):
    """Recording of the six dwells, to be looked at only."""
    folder = tmp_path_factory.mktemp("tiny")
    (folder / "tiny.toml").write_text(TINY)
    assert (
        tumble("run", "--programme", folder / "tiny.toml", "--serial", "SN-7", "--out", folder / "x.mcap").status == 0
    )
    return folder / "x.mcap"


@pytest.fixture
def no_report(monkeypatch):
    """Drawing takes two seconds; a test of something else does without."""
    monkeypatch.setattr("tumble.calibrations.report.page.html", lambda _: "<html></html>")


@pytest.fixture
def programme(write):
    return write("twice.toml", TWICE)


@pytest.fixture
def copy_at(monkeypatch):
    """Has what is on the disk copied when a point was completed: what a process that is killed then leaves."""

    def arrange(index, target):
        record = Recorder.record

        def record_and_copy(recorder, event):
            record(recorder, event)
            if isinstance(event, PointCompleted) and event.point.index == index and not target.exists():
                shutil.copyfile(recorder.path, target)

        monkeypatch.setattr(Recorder, "record", record_and_copy)

    return arrange


@pytest.fixture(scope="session")
def cut_everywhere(tmp_path_factory):
    """The programme run once: the whole recording, and what was on the disk after each point; to be copied."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "twice.toml").write_text(TWICE, "utf-8")
    record = Recorder.record

    def record_and_copy(recorder, event):
        record(recorder, event)
        if isinstance(event, PointCompleted):
            shutil.copyfile(recorder.path, folder / f"{event.point.index}.mcap")

    with patch.object(Recorder, "record", record_and_copy):
        ran = tumble("run", "--programme", folder / "twice.toml", "--serial", "A", "--out", folder / "whole.mcap")
    assert ran.status == 0, ran.err
    return folder


@pytest.fixture
def cut(programme, tmp_path, copy_at, cut_everywhere):
    """Runs a programme; returns the whole recording, and one that was cut off after a number of points."""

    def run(points, *options):
        whole, broken = tmp_path / "whole.mcap", tmp_path / "run.mcap"
        if options:
            copy_at(points - 1, broken)
            assert tumble("run", "--programme", programme, "--serial", "A", "--out", whole, *options).status == 0
        else:
            shutil.copyfile(cut_everywhere / "whole.mcap", whole)
            shutil.copyfile(cut_everywhere / f"{points - 1}.mcap", broken)
        assert len(read_recording(broken).points) == points
        return whole, broken

    return run
