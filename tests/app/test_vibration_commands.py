"""Vibrated dwells on the command line: reduced, fitted, traced, predicted, reported."""

import json
import sys

import numpy as np
import pytest
from vibration_tables import I, O, dwells, measured

import tumble
from tumble.app.cli import main
from tumble.calibrations.core.table import write_table
from tumble.calibrations.methods.vibration.probes import shaken
from tumble.calibrations.methods.vibration.profile import Profile, read_spectrum, shipped_profiles


@pytest.fixture
def samples(tmp_path):
    path, rng = tmp_path / "samples.csv", np.random.default_rng(1)
    lines = ["dwell,time_s,kind,drive_Hz,output_g,reference_i_g"]
    for dwell, amplitude in enumerate((0.0, 5.0, 0.0), start=1):
        for number in range(400):
            motion = amplitude * np.sin(2.0 * np.pi * 23.1 * number / 400.0)
            output = motion + 3e-5 * motion**2 + rng.normal(0.0, 1e-4)
            kind, drive = ("vibration", 23.0) if amplitude else ("rest", 0.0)
            lines.append(f"{dwell},{10 * dwell + number / 400.0},{kind},{drive},{output:.9f},{motion:.7f}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "dwells.csv"
    write_table(measured(dwells(shaken(I, O))), path)
    return path


def run(monkeypatch, *arguments):
    monkeypatch.setattr(sys, "argv", ["tumble", *map(str, arguments)])
    try:
        main()
    except SystemExit as leaving:
        return leaving.code
    return 0


def test_samples_become_a_table_a_document_and_a_report(monkeypatch, samples, tmp_path, capsys):
    out, table, page = tmp_path / "o.json", tmp_path / "t.csv", tmp_path / "r.html"
    assert run(monkeypatch, "reduce", samples, "--json", out, "--table", table, "--report", page) == 0
    found = json.loads(out.read_text("utf-8"))
    assert found["schema"] == "tumble.dwells/1"
    assert found["vre"]["value_ug"] == pytest.approx(375.0, abs=30.0)
    assert table.read_text("utf-8").startswith("time_s,apparatus,mounting")
    assert "<svg" in page.read_text("utf-8")


def test_samples_are_not_traced_and_tables_are_not_reduced(monkeypatch, samples, table, capsys):
    assert run(monkeypatch, "close-loop", samples) == 2
    assert "`tumble reduce` makes a table of dwells of them" in capsys.readouterr().err
    assert run(monkeypatch, "reduce", table) == 2
    assert "no samples of dwells" in capsys.readouterr().err


def test_a_table_is_traced_and_reported(monkeypatch, table, tmp_path, capsys):
    out, page = tmp_path / "o.json", tmp_path / "r.html"
    assert run(monkeypatch, "close-loop", table, "--json", out, "--report", page) == 0
    found = json.loads(out.read_text("utf-8"))
    assert (found["method"], found["effects"]) == ("vibration", [])
    assert "DC against mean square" in page.read_text("utf-8")


def test_random_vibration_is_predicted(monkeypatch, table, tmp_path, capsys):
    out = tmp_path / "o.json"
    assert run(monkeypatch, "predict", table, "--psd", "minimum-integrity", "--json", out) == 0
    found = json.loads(out.read_text("utf-8"))
    assert found["value_ug"] == pytest.approx(12.0 * 7.694**2, rel=0.02)
    assert found["beyond_measured_frequencies"] is True
    assert run(monkeypatch, "predict", table, "--psd", "no-such") == 2
    assert "known are minimum-integrity, truck-longitudinal" in capsys.readouterr().err


def test_profiles_have_their_printed_levels():
    """MIL-STD-810H, method 514.8: 7.7, 0.740, 0.204 and 1.04 g r.m.s."""
    levels = [read_spectrum(name).rms_g for name in shipped_profiles()]
    assert levels == pytest.approx([7.69, 0.740, 0.204, 1.043], abs=0.005)


def test_the_area_of_a_power_law_is_exact():
    falling = Profile(name="1/f", f_hz=np.array([10.0, 1000.0]), g_g2_hz=np.array([0.1, 0.001]))
    assert falling.mean_square_g2 == pytest.approx(np.log(100.0))


def test_samples_are_reduced_in_python(samples):
    assert len(tumble.reduce(samples).rows(1)) == 3
