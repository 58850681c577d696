"""A still recording among the runs of a triad: its noise in the result, the report and the sections of the window."""

import json
from pathlib import Path

import pytest
from app_jobs import tumble

import tumble as product

POSITIONS = """method = "triad"
name = "positions"
dwell_s = 0.2
settle_s = 0.1

[[procedure]]
list = "12o"
"""
STILL = """method = "triad"
name = "left-alone"
dwell_s = {dwell_s}
settle_s = 0.1

[[procedure]]
positions = [[90, 0]]
"""


def run(name, text):
    Path(f"{name}.toml").write_text(text, "utf-8")
    ran = tumble("run", "--programme", f"{name}.toml", "--serial", "T1", "--out", f"{name}.mcap")
    assert ran.status == 0, ran.err


@pytest.fixture(scope="module", autouse=True)
def figures():
    """They are drawn here."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Positions, and a still recording of ten minutes."""
    folder = tmp_path_factory.mktemp("still")
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(folder)
        run("positions", POSITIONS)
        run("still", STILL.format(dwell_s=600))
    return folder


@pytest.fixture(autouse=True)
def there(folder, monkeypatch):
    monkeypatch.chdir(folder)


def closed(*arguments):
    ran = tumble("close-loop", *arguments, "--json", "loop.json", "--report", "loop.html")
    assert ran.status == 0, ran.err
    return json.loads(Path("loop.json").read_text("utf-8")), Path("loop.html").read_text("utf-8")


@pytest.fixture(scope="module")
def recorded(folder):
    """What is said of both, with a record of it: document and report."""
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(folder)
        return closed("positions.mcap", "still.mcap", "--record", "--store", "s")


def test_a_dwell_of_ten_minutes_tells_the_noise(recorded):
    document, page = recorded

    noise = document["allan"]
    assert noise["samples"] == 30_000
    assert {*noise["outputs"]} == {"u_x_V", "u_y_V", "u_z_V"}
    white = noise["outputs"]["u_x_V"]["coefficients"]["N"]
    assert white["value"] > 3.0 * white["standard_uncertainty"]
    assert "How long to average" in page
    assert "Allan deviation over averaging time" in page


def test_short_dwells_tell_none():
    run("short", STILL.format(dwell_s=100))

    document, page = closed("positions.mcap", "short.mcap")

    assert "allan" not in document
    assert "How long to average" not in page


def test_a_record_of_files_beside_its_store_is_verified(recorded):
    assert "1 of 1 record agrees" in tumble("records", "verify", "--store", "s").out


def test_the_noise_is_told_from_the_recording_alone_and_makes_a_programme():
    ran = tumble("allan", "still.mcap", "--json", "a.json")

    assert ran.status == 0, ran.err
    noise = json.loads(Path("a.json").read_text("utf-8"))
    assert noise["samples"] == 30_000
    assert {*noise["outputs"]} == {"u_x_V", "u_y_V", "u_z_V"}
    assert product.allan("still.mcap").document() == noise


def test_dwells_of_few_samples_are_refused_in_a_sentence():
    ran = tumble("allan", "positions.mcap")

    assert (ran.status, ran.out) == (2, "")
    assert "positions.mcap: its first dwell has fewer than" in ran.err
