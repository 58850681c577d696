"""A gyro platform at its built-in stand: from nothing to a record and a report, by the commands of every method."""

import json
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from app_jobs import tumble

from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.reader import read_recording

SHORT = """method = "gyrocompass"
name = "short"
dwell_s = 2.0

[[procedure]]
positions = "0/180/90/270"
"""
TWO_BASES = (
    SHORT.replace("[[procedure]]", "realisations = 2\n\n[[procedure]]\nbase = 1")
    + """
[[procedure]]
positions = "0/90"
base = 2
"""
)
RUN = Path("run.mcap")
TRUTH = {"alpha0": -37.2, "drift": 0.35}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "short.toml").write_text(SHORT)
    (tmp_path / "bases.toml").write_text(TWO_BASES)
    return tmp_path


def run(programme="short.toml", *options):
    assert tumble("run", "--programme", programme, "--serial", "G1", "--out", "run.mcap", *options).status == 0
    return read_recording(RUN)


def test_one_command_leaves_record_and_report(folder):
    ran = tumble("calibrate", "--programme", "0-180-90-270", "--serial", "G1", "--store", "s", "--json", "-")
    assert ran.status == 0
    done = json.loads(ran.out)
    for name, true in TRUTH.items():
        found = done["parameters"][name]
        assert abs(found["value"] - true) < 4.0 * found["standard_uncertainty"]
    assert (folder / done["report"]).is_file()
    assert "1 of 1 record agrees" in tumble("records", "verify", "--store", "s").out


def test_the_vertical_part_is_taken_off_with_the_stated_latitude(folder):
    recorded = run()
    assert tumble("export", "run.mcap", "--out", "run.csv").status == 0
    rows = np.genfromtxt(folder / "run.csv", delimiter=",", names=True)
    for row, point in zip(rows, recorded.points, strict=True):
        tilt_deg = point.readings["tilt_gamma_deg"].mean
        vertical = 15.041068 * np.sin(np.deg2rad(50.45)) * np.sin(np.deg2rad(tilt_deg))
        assert row["rate_deg_h"] == pytest.approx(point.readings["levelling_rate_deg_h"].mean + vertical, abs=1e-9)
        assert (row["dwell_s"], row["latitude_deg"], row["base"]) == (2.0, 50.45, 1)
        assert row["azimuth_rate_deg_h"] == point.readings["azimuth_rate_deg_h"].mean


def test_its_table_is_exported_in_the_columns_of_the_digest(folder):
    run()
    assert tumble("export", "run.mcap", "--out", "run.csv").status == 0
    header = (folder / "run.csv").read_text().splitlines()[0].split(",")
    assert {
        "time_s", "realisation", "base", "azimuth_deg", "direction", "tilt_gamma_deg", "latitude_deg", "dwell_s",
        "temperature_degC", "rate_deg_h", "rate_sd_deg_h", "samples", "azimuth_rate_deg_h",
    } <= set(header)  # fmt: skip
    assert tumble("export", "run.mcap", "--out", "run.csv").status == 0  # over its own


def test_the_truth_of_the_simulated_platform_is_in_no_recording(folder):
    (folder / "stand.toml").write_text(
        'name = "b"\n[site]\nlatitude_deg = 50\n[positioners.azimuth]\ndriver = "simulated"\nlimits_deg = [-10, 370]\n'
        '[samplers.platform]\ndriver = "simulated"\nrate_hz = 10\n'
        '[simulated]\nworld = "gyro_platform"\nalpha0_deg = 12.345678\n'
    )
    assert run("short.toml", "--stand", "stand.toml")
    assert "simulated" not in read_recording(RUN).header.stand
    assert b"12.345678" not in RUN.read_bytes()


def test_another_lean_is_a_prompt_and_a_base_of_its_own(folder):
    recorded = run("bases.toml")
    assert [point.conditions["base"] for point in recorded.points] == [*"111122", *"111122"]
    assert [answer.value for answer in recorded.answers] == ["1", "2", "1", "2"]
    tilts = {point.conditions["base"]: point.readings["tilt_gamma_deg"].mean for point in recorded.points[3:5]}
    assert tilts["2"] == pytest.approx(-0.9, abs=0.01)
    assert "4 mountings by hand" in tumble("plan", "bases.toml").out


def test_limits_are_of_its_own_parameters(folder):
    (folder / "limited.toml").write_text(SHORT + "[limits]\ndrift = { min = 0.0, max = 0.1 }\n")
    ran = tumble("calibrate", "--programme", "limited.toml", "--serial", "G1", "--store", "s")
    assert (ran.status, "drift" in ran.out) == (1, True)


def test_a_stand_without_a_latitude_is_refused_before_anything_moves(folder):
    (folder / "nowhere.toml").write_text(
        'name = "n"\n[positioners.azimuth]\ndriver = "simulated"\nlimits_deg = [-10, 370]\n'
        '[samplers.platform]\ndriver = "simulated"\n[simulated]\nworld = "gyro_platform"\n'
    )
    ran = tumble("run", "--programme", "short.toml", "--stand", "nowhere.toml", "--serial", "G1", "--out", "run.mcap")
    assert (ran.status, RUN.exists()) == (2, False)
    assert "nowhere.toml: gyrocompassing needs the latitude; add latitude_deg to [site]" in ran.err


def cuts(most):
    """Lengths of the whole recording at which it may have been cut off, evenly from its header to its end."""
    length = RUN.stat().st_size
    return np.linspace(length // 8, length - 10, most).astype(int).tolist()


def timeless(point):
    """A point without time and temperatures, which an outage moves."""
    readings = {name: replace(reading, temperature_degc=None) for name, reading in point.readings.items()}
    return replace(point, time_s=0.0, temperature_degc=None, readings=readings)


def test_a_run_that_was_cut_off_anywhere_goes_on_to_the_same_bits():
    whole = [timeless(point) for point in run("bases.toml").points]
    bytes_of_all = RUN.read_bytes()
    seen = set()
    for length in cuts(6):
        RUN.write_bytes(bytes_of_all[:length])
        try:
            seen.add(len(read_recording(RUN).points))
        except RecordingError:
            continue
        assert tumble("resume", RUN).status == 0
        assert [timeless(point) for point in read_recording(RUN).points] == whole
    assert len(seen) > 2


@pytest.mark.parametrize(
    ("positions", "said"),
    [
        ("0/90/180", "In 0.8 min the heading is told to 0.1"),
        ("0/180/90/270", "In 1.5 min the heading is told to 0.1"),
        ("0/0", "The heading is not told by these positions."),
    ],
)
def test_a_plan_says_how_uncertain_the_heading_will_be(positions, said, folder):
    noise = "[noise]\ngauss_markov_deg_h = 0.2\ncorrelation_s = 1000\n"
    (folder / "mine.toml").write_text(SHORT.replace("0/180/90/270", positions) + noise)
    ran = tumble("plan", "mine.toml", "--json", "plan.json")
    assert said in ran.out
    expected = json.loads((folder / "plan.json").read_text())["expected_heading"]
    assert (expected is None) == ("not told" in said)


def test_a_plan_without_a_noise_promises_nothing(folder):
    ran = tumble("plan", "short.toml", "--json", "plan.json")
    assert "heading" not in ran.out
    assert "expected_heading" not in json.loads((folder / "plan.json").read_text())


def test_a_platform_without_the_azimuth_channel_is_run_all_the_same(folder):
    built_in = (files("tumble.procedures.methods.gyrocompass") / "stand.toml").read_text()
    without = 'rate_hz = 10.0\nchannels = ["levelling_rate_deg_h", "tilt_gamma_deg"]'
    (folder / "stand.toml").write_text(built_in.replace("rate_hz = 10.0", without))

    recorded = run("short.toml", "--stand", "stand.toml")

    assert {*recorded.points[0].readings} == {"levelling_rate_deg_h", "tilt_gamma_deg"}
    done = json.loads(tumble("close-loop", "run.mcap", "--json", "-").out)
    alpha0 = done["augmented"]["parameters"]["alpha0"]
    assert abs(alpha0["value"] - TRUTH["alpha0"]) < 4.0 * alpha0["standard_uncertainty"]
    assert done["azimuth_drift"] == {
        "value": None,
        "reason": "its rate was not measured: azimuth_rate_deg_h in two dwells at least",
    }


def test_a_programme_declares_the_noise_in_which_its_run_is_read(folder):
    (folder / "noisy.toml").write_text(SHORT + "\n[noise]\nangle_random_walk_deg_sqrt_h = 5e-4\n")
    run("noisy.toml")
    tumble("export", "run.mcap", "--out", "run.csv")

    of_recording, of_table = (
        json.loads(tumble("close-loop", name, "--json", "-").out)["declared_noise"] for name in ("run.mcap", "run.csv")
    )

    assert tumble("export", "run.mcap", "--out", "run.csv").status == 0  # over its own
    assert of_recording["noise"] == {"angle_random_walk_deg_sqrt_h": 5e-4}
    for name, true in TRUTH.items():
        assert abs(of_recording[name]["value"] - true) < 4.0 * of_recording[name]["standard_uncertainty"]
        assert of_table[name]["value"] == pytest.approx(of_recording[name]["value"], abs=1e-6)
