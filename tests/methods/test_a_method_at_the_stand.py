"""A method plugs in at the stand without a change elsewhere: from programme to closed loop, by the same commands."""

import json
from pathlib import Path

import pytest
from app_jobs import tumble

import tumble as package
from tumble.app import jobs, methods
from tumble.procedures.errors import InputError
from tumble.procedures.recording.reader import read_recording

PROGRAMMES = Path(__file__).parent / "lever_programmes"
REGISTERED = """[tumble.methods]
lever = lever:METHOD
[tumble.procedures]
lever = lever_at_stand:PROCEDURES
[tumble.jobs]
lever = lever:JOB
"""
RESPONSE = "def creeping(ax_g, ay_g, az_g, temperature_degC, time_s):\n    return 2.5 + 0.9 * ax_g + 2e-5 * time_s\n"
STAND = """name = "bench"
[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]
[daq]
driver = "simulated"
samples = 100
rate_hz = 100.0
[simulated]
seed = 5
noise_v = 1e-4
response = "lever_unit.py:creeping"
parameters = { alpha0_deg = 0.0 }
"""


@pytest.fixture(autouse=True)
def bench(tmp_path, monkeypatch):
    """A stand at which levers are measured, where their method is installed; the folder of everything."""
    package = tmp_path / "site" / "lever-1.dist-info"
    package.mkdir(parents=True)
    (package / "METADATA").write_text("Metadata-Version: 2.1\nName: lever\nVersion: 1\n")
    (package / "entry_points.txt").write_text(REGISTERED)
    (tmp_path / "lever_unit.py").write_text(RESPONSE)
    (tmp_path / "bench.toml").write_text(STAND)
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    monkeypatch.chdir(tmp_path)
    methods.methods.cache_clear()
    yield tmp_path
    methods.methods.cache_clear()


AT = ("--stand", "bench.toml", "--serial", "L1")


@pytest.fixture
def recording(bench):
    assert tumble("run", "--programme", "lever-up", *AT, "--out", "up.mcap").status == 0
    return bench / "up.mcap"


def loop_of(*arguments):
    return json.loads(tumble("close-loop", *arguments, "--json", "-").out)


def test_its_programme_is_planned_by_name():
    assert "lever-up: 60 dwells between 0° and 295°" in tumble("plan", "lever-up").out


def test_its_run_leaves_a_recording_that_names_it(recording):
    header = read_recording(recording).header
    assert (header.method, header.method_version) == ("lever", 3)


def test_its_recording_is_fitted(recording):
    fitted = json.loads(tumble("fit", recording, "--json", "-").out)
    assert fitted["parameters"]["k"]["value"] == pytest.approx(-0.9, abs=0.01)


def test_its_table_is_exported_in_its_own_columns_and_read_again(recording, bench):
    tumble("export", recording, "--out", "up.csv")
    header, *rows = (bench / "up.csv").read_text().splitlines()
    assert (header, len(rows)) == ("time_s,realisation,lever_deg,load_V", 60)
    assert tumble("export", recording, "--out", "up.csv").status == 0
    assert loop_of("up.csv")["effects"] == loop_of(recording)["effects"]


def test_what_one_sweep_cannot_tell_is_told_with_the_experiment_that_can(recording):
    loop = loop_of(recording)
    (effect,) = loop["effects"]
    assert {effect["name"], *effect["also_possible"]} == {"drift", "twist"}
    assert "--programme lever-back" in loop["next_experiment"][0]["command"]


def test_its_files_are_taken_together(recording):
    tumble("run", "--programme", "lever-back", *AT, "--out", "back.mcap")
    assert loop_of(recording, "back.mcap")["rows"]["used"] == 60 + 119


def test_its_loop_acts_with_its_experiment(bench):
    loop = loop_of("--programme", "lever-up", *AT, "--experiments", "2", "--store", "s")
    assert [each["programme"] for each in loop["experiments"]] == ["lever-back"]
    assert loop["ended"]["how"] == "told apart"
    (effect,) = loop["effects"]
    assert effect["coefficients"]["drift_V_per_h"]["value"] == pytest.approx(2e-5 * 3600.0, rel=0.01)
    assert "1 of 1 record agrees" in tumble("records", "verify", loop["record"], "--store", "s").out


@pytest.fixture
def calibrated(bench):
    ran = tumble("calibrate", "--programme", "lever-up", *AT, "--store", "s", "--json", "-")
    assert ran.status == 0
    return json.loads(ran.out)


def test_its_calibration_is_a_record_that_comes_back(calibrated):
    assert "method     lever, version 3" in tumble("records", "show", calibrated["record"], "--store", "s").out
    verified = tumble("records", "verify", "--store", "s")
    assert (verified.status, "every parameter comes back" in verified.out) == (0, True)


def test_its_report_is_written_and_written_again(calibrated, bench):
    assert "What bends the lever" in (bench / calibrated["report"]).read_text("utf-8")
    assert tumble("report", calibrated["record"], "--out", "again.html", "--store", "s").status == 0
    assert "What bends the lever" in (bench / "again.html").read_text("utf-8")


def test_findings_are_on_the_terminal_with_what_they_leave_open(bench):
    said = tumble("calibrate", "--programme", "lever-up", *AT, "--store", "s").out
    assert "│ drift  │ twist │" in said
    assert "it differs between drift and twist" in said


@pytest.mark.parametrize(("verbose", "told"), [((), "60 rows"), (("--verbose",), "residual ")])
def test_a_value_without_an_interval_is_on_the_terminal(recording, verbose, told):
    said = tumble("fit", recording, *verbose).out
    assert "│ k         │ -900.644(" in said
    assert told in said


def test_its_limits_are_of_its_own_parameters(bench):
    text = (PROGRAMMES / "lever-up.toml").read_text() + "[limits]\nkx = { min = 0.0, max = 1.0 }\n"
    (bench / "limited.toml").write_text(text)
    ran = tumble("calibrate", "--programme", "limited.toml", *AT, "--store", "s")
    assert (ran.status, "limits kx, and the parameters are u0 and k" in ran.err) == (2, True)


@pytest.mark.parametrize(("most", "status", "word"), [(-0.5, 0, "pass"), (-1.0, 1, "fail")])
def test_its_values_are_held_against_the_limits_of_its_programme(bench, most, status, word):
    text = (PROGRAMMES / "lever-up.toml").read_text() + f"[limits]\nk = {{ min = -2.0, max = {most} }}\n"
    (bench / "limited.toml").write_text(text)
    ran = tumble("calibrate", "--programme", "limited.toml", *AT, "--store", "s", "--json", "-")
    assert (ran.status, json.loads(ran.out)["verdict"]["outcome"]) == (status, word)
    assert word in tumble("records", "list", "--store", "s").out


def test_a_recording_that_was_cut_off_is_told_with_its_result(recording):
    recording.write_bytes(recording.read_bytes()[:-2000])
    assert "cut off" in tumble("fit", recording).err


def test_a_run_that_was_cut_off_goes_on(recording, bench):
    whole = recording.read_bytes()
    recording.write_bytes(whole[: len(whole) // 2])
    assert tumble("resume", recording, "--tolerance-v", "0.01").status == 0  # it has drifted meanwhile
    assert len(read_recording(recording).points) == 60


def test_a_file_of_another_method_does_not_go_with_it(recording, bench):
    (bench / "head.csv").write_text("angle_deg,voltage_V\n0,2.5\n90,1.5\n180,2.5\n270,3.5\n")
    ran = tumble("close-loop", recording, "head.csv")
    assert (ran.status, "different kinds" in ran.err) == (2, True)


def test_nothing_is_learned_of_its_stand(recording):
    assert "nothing of its stand is to be learned" in tumble("stand", "learn", recording, "--store", "s").out


@pytest.mark.parametrize("command", ["calibrate", "close-loop"])
def test_without_its_job_nothing_is_measured_that_would_not_be_analysed(bench, monkeypatch, command):
    entries = bench / "site" / "lever-1.dist-info" / "entry_points.txt"
    entries.write_text(REGISTERED.partition("[tumble.jobs]")[0])
    monkeypatch.syspath_prepend(str(bench / "elsewhere"))  # what is installed is looked up anew
    ran = tumble(command, "--programme", "lever-up", *AT, "--store", "s")
    assert (ran.status, "no analysis of its recordings is installed" in ran.err) == (2, True)
    assert not list(bench.rglob("*.mcap"))


def test_a_notebook_fits_and_traces_it(recording):
    assert package.fit(recording).values[1]["name"] == "k"
    assert package.close_loop(recording).to_dict()["loop"]["effects"]


def test_an_installation_that_knows_no_job_says_so(monkeypatch):
    monkeypatch.setattr(jobs.plugins, "names", lambda _: [])
    with pytest.raises(InputError, match="install tumble again"):
        jobs.job_names()
