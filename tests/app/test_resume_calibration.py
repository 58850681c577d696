import json
import shutil
from pathlib import Path

import pytest
from app_jobs import STAND, tumble
from cut_runs import TWICE, moved

DRIFTING = (
    STAND
    + """\
flicker_v = 2e-5
effects = { backlash = 0.002, bias_drift = 2e-3, scale_drift = 1e-3, bias_temperature = 5e-4, bias_random_walk = 1e-4 }
"""
)


def test_a_calibration_goes_on_to_its_record_and_its_report(programme, tmp_path, copy_at, no_report):
    store, cut_off = tmp_path / "store", tmp_path / "cut.mcap"
    copy_at(14, cut_off)
    first = tumble("calibrate", "--programme", programme, "--serial", "A", "--store", store, "--json", "-")
    recording = Path(json.loads(first.out)["recording"])
    shutil.rmtree(store)
    recording.parent.mkdir(parents=True)
    shutil.copyfile(cut_off, recording)

    ran = tumble("resume", recording, "--json", "-")

    assert ran.status == 0, ran.err
    again = json.loads(ran.out)
    assert again["parameters"] == json.loads(first.out)["parameters"]
    assert Path(again["report"]).is_file()
    assert "--store" in tumble("resume", moved(recording, tmp_path / "moved.mcap")).complaint


@pytest.fixture
def finished(programme, tmp_path, no_report):
    """A store with a calibration that is finished, and what it said."""
    store = tmp_path / "store"
    ran = tumble("calibrate", "--programme", programme, "--serial", "A", "--store", store, "--json", "-")
    assert ran.status == 0, ran.err
    return store, json.loads(ran.out)


def test_a_calibration_that_is_finished_is_told_and_not_stored_again(finished):
    store, said = finished
    ran = tumble("resume", said["recording"], "--json", "-")
    assert ran.status == 0, ran.err
    assert ran.err == f"{said['recording']} is complete, and record {said['record']} of it exists: nothing was done\n"
    assert json.loads(ran.out) == said
    (listed,) = json.loads(tumble("records", "list", "--store", store, "--json", "-").out)["records"]
    assert listed["revision"] == 1


def test_a_calibration_that_was_cut_off_before_its_report_gets_it_and_no_second_record(finished):
    store, said = finished
    Path(said["report"]).unlink()
    ran = tumble("resume", said["recording"], "--json", "-")
    assert ran.status == 0, ran.err
    assert ran.err.endswith("exists: only its report was missing\n")
    assert Path(json.loads(ran.out)["report"]).is_file()
    assert len(json.loads(tumble("records", "list", "--store", store, "--json", "-").out)["records"]) == 1


def test_a_calibration_that_was_cut_off_before_its_record_gets_one(finished):
    store, said = finished
    (store / "records.sqlite").unlink()
    Path(said["report"]).unlink()
    again = json.loads(tumble("resume", said["recording"], "--json", "-").out)
    assert again["record"] != said["record"]
    assert again["parameters"] == said["parameters"]


def test_a_finished_calibration_outside_its_limits_still_is(programme, tmp_path, write, no_report):
    narrow = write("narrow.toml", TWICE + "\n[limits]\nkx = { min = 2.0, max = 3.0 }\n")
    ran = tumble("calibrate", "--programme", narrow, "--serial", "A", "--store", tmp_path / "store", "--json", "-")
    assert ran.status == 1
    assert tumble("resume", json.loads(ran.out)["recording"]).status == 1


def test_with_drift_backlash_and_flicker_a_resumed_calibration_agrees(cut, write, no_report):
    stand = write("drifting.toml", DRIFTING)
    whole, broken = cut(11, "--stand", stand)
    assert tumble("resume", broken).status == 0
    documents = [json.loads(tumble("fit", path, "--json", "-").out) for path in (whole, broken)]
    for name, expected in documents[0]["parameters"].items():
        if expected["value"] is not None:
            off = documents[1]["parameters"][name]["value"] - expected["value"]
            assert abs(off) < 0.1 * expected["standard_uncertainty"], name
