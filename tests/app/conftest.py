"""Fixtures of the application's tests."""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest
from app_jobs import STAND, TINY, Ran, blank_figures, cheaply, few_trials_of, tracing_once, tumble

from tumble.calibrations.methods.dividing_head import analysis


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
            "calibrate", "--programme", "quick", "--serial", "SN-7", "--operator", "Оксана",
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
