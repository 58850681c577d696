import csv
import json

import pytest
from app_jobs import STAND, tumble

from tumble.procedures.recording.reader import read_recording


def fitted(*arguments):
    ran = tumble("fit", *arguments, "--json", "-")
    assert ran.status == 0
    return json.loads(ran.out)


def test_a_recording_fits_to_what_calibrate_said(calibrated):
    document = fitted(calibrated.recording)

    assert document["parameters"] == calibrated.document["parameters"]


def test_an_exported_table_has_a_row_for_every_dwell(calibrated, tmp_path):
    ran = tumble("export", calibrated.recording, "--out", tmp_path / "x.csv")

    with (tmp_path / "x.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert ran.status == 0
    assert len(rows) == 60
    assert (rows[0]["procedure"], rows[0]["mount"], rows[0]["samples"]) == ("flip", "face-up", "20")
    assert float(rows[0]["angle_deg"]) == -90.0


def test_an_exported_table_fits_like_the_recording_but_for_what_the_stand_adds(calibrated, tmp_path):
    tumble("export", calibrated.recording, "--out", tmp_path / "x.csv")

    found = fitted(tmp_path / "x.csv")["parameters"]

    for name, parameter in calibrated.document["parameters"].items():
        assert found[name]["value"] == pytest.approx(parameter["value"], rel=1e-12)
        assert found[name]["type_a"] == pytest.approx(parameter["type_a"], rel=1e-9)
        assert found[name]["standard_uncertainty"] == found[name]["type_a"]


def test_a_table_with_a_stand_file_has_that_stand_in_its_budget(calibrated, write, tmp_path):
    tumble("export", calibrated.recording, "--out", tmp_path / "x.csv")
    stand = write("b.toml", STAND.replace("[daq]\n", "[daq]\ngain_uncertainty = 1e-3\n"))

    kx = fitted(tmp_path / "x.csv", "--stand", stand)["parameters"]["kx"]

    assert kx["standard_uncertainty"] == pytest.approx(1e-3, rel=1e-2)


def test_a_stand_file_takes_the_place_of_the_recorded_one(calibrated, stand):
    budget = fitted(calibrated.recording, "--stand", stand)["budget"]

    assert [line["kind"] for line in budget] == ["A"]


def test_a_table_lies_beside_its_recording_without_out(copied):
    tumble("export", copied.recording)

    assert copied.recording.with_suffix(".csv").is_file()


def test_json_on_standard_output_comes_alone(tiny, stand, tmp_path, tiny_recording, no_report):
    measure = ("--programme", tiny, "--serial", "A", "--store", tmp_path / "s", "--json", "-")
    calls = (
        ("calibrate", *measure),
        ("run", *measure),
        ("plan", tiny, "--json", "-"),
        ("fit", tiny_recording, "--store", tmp_path / "s", "--json", "-"),
        ("records", "list", "--store", tmp_path / "s", "--json", "-"),
    )
    schemas = [json.loads(tumble(*call).out)["schema"] for call in calls]

    assert schemas == ["tumble.fit/1", "tumble.run/1", "tumble.plan/1", "tumble.fit/1", "tumble.records/1"]


def test_a_run_says_where_its_recording_lies(tiny, tmp_path):
    ran = tumble("run", "--programme", tiny, "--serial", "SN 7/б", "--store", tmp_path, "--json", tmp_path / "run.json")

    document = json.loads((tmp_path / "run.json").read_text())
    (recording,) = (tmp_path / "recordings").glob("SN_7-*/*-tiny.mcap")
    assert (document["recording"], document["points"]) == (str(recording), 6)
    assert f"recording {recording}" in ran.err
    assert read_recording(recording).header.serial_number == "SN 7/б"


def test_two_runs_of_one_unit_have_recordings_of_their_own(tiny, tmp_path):
    for _ in range(3):
        assert tumble("run", "--programme", tiny, "--serial", "A", "--store", tmp_path).status == 0

    assert len(list(tmp_path.glob("recordings/A/*.mcap"))) == 3


def test_a_report_lies_beside_its_table(write, no_report):
    rows = "".join(f"{angle},{2.5 + angle % 7}\n" for angle in range(0, 360, 30))
    table = write("t.csv", f"angle_deg,voltage_V\n{rows}")

    ran = tumble("report", table)

    assert ran.status == 0
    assert table.with_suffix(".html").is_file()
    assert ran.out == f"report {table.with_suffix('.html')}\n"


def test_a_report_of_a_record_goes_to_the_store(copied, no_report):
    record = copied.document["record"]
    page = copied.store / "reports" / f"{record}.html"
    page.unlink()

    assert tumble("report", record, "--store", copied.store).status == 0
    assert page.read_text() == "<html></html>"
