"""A triad at its built-in stand: from nothing to a record and a report, by the commands that serve every method."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from app_jobs import tumble

import tumble as product
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.reader import read_recording

SHORT = """method = "triad"
name = "short"
dwell_s = 0.2
settle_s = 0.1

[[procedure]]
list = "12o"
"""
RUN = Path("run.mcap")
TRUTH = {"bias_x": 0.0031, "scale_z": 1.004, "m_xz": -340.0, "level_x": 25.0}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "short.toml").write_text(SHORT)
    return tmp_path


def run(programme="short.toml"):
    assert tumble("run", "--programme", programme, "--serial", "T1", "--out", "run.mcap").status == 0
    return read_recording(RUN)


def test_one_command_leaves_record_and_report(folder):
    ran = tumble("calibrate", "--programme", "24", "--serial", "T1", "--store", "s", "--json", "-")
    assert ran.status == 0
    done = json.loads(ran.out)
    for name, true in TRUTH.items():
        found = done["parameters"][name]
        assert abs(found["value"] - true) < 4.0 * found["standard_uncertainty"]
    page = (folder / done["report"]).read_text("utf-8")
    assert "Mismatch by position" in page
    assert "Correction a = C (u - b)" in page
    assert "1 of 1 record agrees" in tumble("records", "verify", "--store", "s").out


def test_a_notebook_plots_what_its_loop_found():
    run()
    assert product.close_loop(RUN).plot().svg.startswith("<svg")


def test_its_plan_names_both_axes():
    assert "position 1, 24 settings" in tumble("plan", "24").out


def test_a_point_holds_both_axes_and_three_channels_each_with_its_temperature():
    point = run().points[3]
    assert set(point.positions_deg) == {"outer", "inner"}
    assert all(reading.temperature_degc == pytest.approx(23.0, abs=0.5) for reading in point.readings.values())


def test_its_table_is_exported_in_the_columns_of_the_contract(folder):
    run()
    assert tumble("export", "run.mcap", "--out", "run.csv").status == 0
    header = (folder / "run.csv").read_text().splitlines()[0].split(",")
    assert {"outer_deg", "inner_deg", "u_x_V", "sd_z_V", "samples", "temperature_y_degC"} <= set(header)
    from_table, from_run = (
        json.loads(tumble("close-loop", name, "--json", "-").out)["declared"]["parameters"]
        for name in ("run.csv", "run.mcap")
    )
    said = ("value", "type_a", "unit")
    assert {name: [each[key] for key in said] for name, each in from_table.items()} == {
        name: [each[key] for key in said] for name, each in from_run.items()
    }


def test_the_truth_of_the_simulated_unit_is_in_no_recording(folder):
    (folder / "stand.toml").write_text(
        'name = "b"\n[positioners.outer]\ndriver = "simulated"\nlimits_deg = [-190, 190]\n'
        '[positioners.inner]\ndriver = "simulated"\nlimits_deg = [-190, 190]\n'
        '[samplers.triad]\ndriver = "simulated"\n[simulated]\nworld = "two_axes"\nparameters = { bias_x = 0.0123456 }\n'
    )
    ran = tumble("run", "--programme", "short.toml", "--stand", "stand.toml", "--serial", "T", "--out", "r.mcap")
    assert ran.status == 0
    assert "simulated" not in read_recording(Path("r.mcap")).header.stand
    assert b"0.0123456" not in (folder / "r.mcap").read_bytes()


def test_limits_are_of_its_own_parameters(folder):
    (folder / "limited.toml").write_text(SHORT + "[limits]\nbias_x = { min = 0.0, max = 0.001 }\n")
    ran = tumble("calibrate", "--programme", "limited.toml", "--serial", "T1", "--store", "s")
    assert (ran.status, "bias_x" in ran.out) == (1, True)


def test_a_dividing_head_is_no_stand_for_it(folder):
    (folder / "head.toml").write_text(
        'name = "h"\n[head]\ndriver = "simulated"\nlimits_deg = [-180, 760]\n[daq]\ndriver = "simulated"\n'
    )
    ran = tumble("run", "--programme", "short.toml", "--stand", "head.toml", "--serial", "T1", "--out", "r.mcap")
    assert (ran.status, "needs the positioner inner; the stand has head" in ran.err) == (2, True)


def cut_after(points):
    """Break the recording off so that so many points are left."""
    whole = RUN.read_bytes()
    for length in range(len(whole), 0, -200):
        RUN.write_bytes(whole[:length])
        try:
            if len(read_recording(RUN).points) == points:
                return
        except RecordingError:
            break
    raise AssertionError("no such cut")


@pytest.mark.parametrize("points", [0, 1, 5, 11])
def test_a_run_that_was_cut_off_goes_on_to_the_same_bits(points):
    whole = [timeless(point) for point in run().points]
    cut_after(points)
    assert tumble("resume", RUN).status == 0
    assert [timeless(point) for point in read_recording(RUN).points] == whole


def timeless(point):
    """A point without time and temperatures, which an outage moves."""
    readings = {name: replace(reading, temperature_degc=None) for name, reading in point.readings.items()}
    return replace(point, time_s=0.0, temperature_degc=None, readings=readings)


def test_values_are_printed_once(folder):
    ran = tumble("calibrate", "--programme", "short.toml", "--serial", "T1", "--store", "s")
    assert ran.status == 0
    assert ran.out.count("│ scale_x") == 1


def test_values_of_a_recording_are_printed_once(folder):
    run()
    ran = tumble("close-loop", "run.mcap")
    assert ran.status == 0
    assert ran.out.count("│ scale_x") == 1


def test_the_report_shows_every_position(folder):
    run()
    assert tumble("report", "run.mcap", "--out", "r.html").status == 0
    page = (folder / "r.html").read_text("utf-8")
    assert "12: 180°, -90°" in page
    assert "Mismatch over the poses" in page


def test_its_positions_are_drawn_before_anything_moves(folder):
    ran = tumble("plan", "short.toml", "--pictures", "p.html")
    assert ran.status == 0
    assert "12: 180°, -90°" in (folder / "p.html").read_text("utf-8")


def test_a_method_that_draws_no_positions_says_so():
    ran = tumble("plan", "quick", "--pictures", "p.html")
    assert ran.status == 2
    assert "draws no positions; leave --pictures out" in ran.err
