import json

import pytest
from app_jobs import STAND, TINY, tumble

from tumble.procedures.recording.reader import read_recording

PUBLISHED = {"u0": 2.5, "kx": 1.0, "ky": 0.0098, "kz": 0.002, "kxy": 0.001, "alpha0": 0.1121}
UNITS = {"u0": "V", "kx": "V/g", "ky": "V/g", "kz": "V/g", "kxy": "V/g^2", "alpha0": "deg"}


def test_calibrate_leaves_recording_record_report_and_result(calibrated):
    assert calibrated.ran.status == 0
    assert read_recording(calibrated.recording).complete
    assert [path.suffix for path in calibrated.store.glob("reports/*")] == [".html"]
    assert (calibrated.store / "records.sqlite").is_file()
    assert calibrated.document["recording"] == str(calibrated.recording)
    assert calibrated.document["report"] == str(calibrated.store / "reports" / f"{calibrated.document['record']}.html")


def test_calibrate_says_on_standard_error_where_everything_lies(calibrated):
    for name in ("recording", "record", "report"):
        assert calibrated.document[name] in calibrated.ran.err


def test_the_result_is_printed_with_uncertainties(calibrated):
    rows = {line.split("│")[1].strip(): line for line in calibrated.ran.out.splitlines() if line.count("│") > 2}

    assert list(rows) == list(PUBLISHED)
    assert "1.0000" in rows["kx"]
    assert "lack of fit: p = " in calibrated.ran.out


def test_the_json_has_every_key_of_its_format(calibrated):
    document = calibrated.document

    assert document["schema"] == "tumble.fit/1"
    assert document["rows"] == {"read": 60, "used": 60, "set_aside": []}
    assert {"pure_error_V", "degrees_of_freedom"} <= set(document["noise"])
    assert {name: entry["unit"] for name, entry in document["parameters"].items()} == UNITS
    assert all({"value", "standard_uncertainty"} <= set(entry) for entry in document["parameters"].values())
    assert {"residual_rms_V", "held_out_rms_V", "lack_of_fit_p"} <= set(document)
    assert {"x", "y", "z", "p_value"} <= set(document["flip_closure"])
    assert {"u0_V", "standard_uncertainty"} == set(document["flip_closure"]["x"])
    assert list(document["published_method"]["parameters"]) == list(PUBLISHED)


@pytest.mark.parametrize("name", PUBLISHED)
def test_what_was_put_in_comes_out(calibrated, name):
    found = calibrated.document["parameters"][name]

    assert abs(found["value"] - PUBLISHED[name]) < 3 * found["standard_uncertainty"]


def test_the_recording_knows_unit_lot_operator_and_programme(calibrated):
    header = read_recording(calibrated.recording).header

    assert (header.serial_number, header.lot, header.operator) == ("SN-7", "L 26/3", "Оксана")
    assert 'name = "quick"' in header.programme_text


def test_blanks_are_no_lot_and_those_round_one_none_of_it(write, tmp_path):
    programme, recording = write("tiny.toml", TINY), tmp_path / "run.mcap"
    for given, lot in (("  ", ""), (" L 1 ", "L 1")):
        ran = tumble("run", "--programme", programme, "--serial", " A ", "--lot", given, "--out", recording)
        header = read_recording(recording).header
        recording.unlink()

        assert (ran.status, header.serial_number, header.lot) == (0, "A", lot)


def test_a_letter_of_two_characters_is_the_same_name_as_that_of_one(write, tmp_path):
    recording, lot = tmp_path / "run.mcap", "\N{CYRILLIC CAPITAL LETTER I}\N{COMBINING BREVE}-26"
    ran = tumble("run", "--programme", write("tiny.toml", TINY), "--serial", "A", "--lot", lot, "--out", recording)
    assert (ran.status, read_recording(recording).header.lot) == (0, "Й-26")


def test_the_report_names_unit_and_record(calibrated):
    (page,) = calibrated.store.glob("reports/*.html")
    text = page.read_text("utf-8")

    assert "SN-7" in text
    assert calibrated.document["record"] in text


def calibrate_with(write, tmp_path, limits):
    programme = write("limited.toml", f"{TINY}\n[limits]\n{limits}\n")
    ran = tumble("calibrate", "--programme", programme, "--serial", "A", "--store", tmp_path / "s", "--json", "-")
    listed = tumble("records", "list", "--store", tmp_path / "s", "--json", "-")
    (record,) = json.loads(listed.out)["records"]
    return ran, record


def test_a_parameter_inside_its_limits_is_good(write, tmp_path, no_report):
    ran, record = calibrate_with(write, tmp_path, "u0 = { min = 2.49, max = 2.51 }")

    assert ran.status == 0
    assert record["verdict"]["outcome"] == "pass"


def test_a_parameter_outside_its_limits_is_status_1_and_the_record_says_so(write, tmp_path, no_report):
    ran, record = calibrate_with(write, tmp_path, "u0 = { min = 2.6, max = 2.7 }")

    assert ran.status == 1
    assert record["verdict"]["outcome"] == "fail"
    assert record["limits"] == [{"name": "u0", "minimum": 2.6, "maximum": 2.7, "inside": False}]


def test_a_limited_parameter_that_cannot_be_told_is_not_decided(write, tmp_path, no_report):
    ran, record = calibrate_with(write, tmp_path, "kz = { min = -1.0, max = 1.0 }")

    assert ran.status == 1
    assert json.loads(ran.out)["parameters"]["kz"]["value"] is None
    assert record["verdict"]["outcome"] == "not_decided"


def test_the_terminal_marks_what_is_outside(write, tmp_path):
    programme = write("limited.toml", f"{TINY}\n[limits]\nu0 = {{ min = 2.6, max = 2.7 }}\n")
    recording = tmp_path / "x.mcap"
    tumble("run", "--programme", programme, "--serial", "A", "--out", recording)

    ran = tumble("fit", recording)

    assert ran.status == 1
    assert "OUTSIDE LIMITS" in ran.out


def test_an_expired_calibration_is_warned_of(write, tiny, tmp_path):
    stand = write("old.toml", STAND.replace("[head]\n", "[head]\ncalibration_due = 2020-01-31\n"))

    ran = tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    assert ran.status == 0
    assert "warning: stand bench-1: the calibration of the head was due on 2020-01-31; have it done" in ran.err
    assert read_recording(tmp_path / "x.mcap").header.stand["head"]["calibration_due"] == "2020-01-31"


def test_a_calibration_that_is_due_later_is_not(write, tiny, tmp_path):
    stand = write("new.toml", STAND.replace("[head]\n", "[head]\ncalibration_due = 2999-01-31\n"))

    ran = tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    assert "warning" not in ran.err


def test_the_budget_has_a_line_for_what_the_stand_adds(calibrated):
    assert [(line["name"], line["kind"], line["size"]) for line in calibrated.document["budget"][1:]] == [
        ("head reading", "B", "5″ at every setting"),
        ("seating", "B", "10″ at every mounting"),
        ("DAQ gain", "B", "1e-05 relative"),
        ("DAQ offset", "B", "5 µV"),
    ]


def test_a_typed_gravity_gives_coefficients_per_acceleration(write, tiny, tmp_path):
    site = "gravity_m_s2 = 9.81\ngravity_uncertainty_m_s2 = 0.0981"
    stand = write("lab.toml", STAND.replace("latitude_deg = 50.45", site))
    tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    kx = json.loads(tumble("fit", tmp_path / "x.mcap", "--json", "-").out)["per_m_s2"]["kx"]

    assert kx["value"] == pytest.approx(1.0 / 9.81, rel=1e-2)
    assert kx["standard_uncertainty"] >= 0.01 * kx["value"]
    assert kx["unit"] == "V/(m/s^2)"


def test_a_stand_without_a_site_gives_none(write, tiny, tmp_path):
    stand = write("nowhere.toml", STAND.replace("[site]\nlatitude_deg = 50.45\n", ""))
    tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    assert json.loads(tumble("fit", tmp_path / "x.mcap", "--json", "-").out)["per_m_s2"] == {}
