import json
from dataclasses import replace

import numpy as np
import pytest
from app_jobs import STAND, TINY, tumble
from loop_examples import K_XX, MISREAD_ROW, PARTS, k_xx, k_xx_table, misread_table
from tables import table

from tumble.app.joining import read_together
from tumble.app.measurements import provenance
from tumble.calibrations.core.table import write_table
from tumble.calibrations.methods.dividing_head.loop.loop import explain_questioned


@pytest.fixture(scope="session")
def looped(tmp_path_factory):
    """Calls `tumble close-loop` on a table, once for every table; returns the run and the document."""
    folder = tmp_path_factory.mktemp("looped")
    made = {"k_xx": k_xx_table, "misread": misread_table, "clean": lambda: table(*PARTS, realisations=3)}
    done = {}

    def run(name):
        if name not in done:
            write_table(made[name](), folder / f"{name}.csv")
            ran = tumble("close-loop", folder / f"{name}.csv", "--json", folder / f"{name}.json")
            assert ran.status == 0, ran.err
            done[name] = ran, json.loads((folder / f"{name}.json").read_text("utf-8"))
        return done[name]

    return run


@pytest.fixture
def k_xx_csv(tmp_path):
    write_table(k_xx_table(), tmp_path / "k_xx.csv")
    return tmp_path / "k_xx.csv"


def lines_with(text, word):
    return [line for line in text.splitlines() if word in line]


def test_an_effect_is_printed_with_owner_size_and_uncertainty(looped):
    ran, _ = looped("k_xx")

    assert "What the declared model leaves was traced to k_xx." in ran.out
    (line,) = lines_with(ran.out, "│ k_xx")
    assert "unit" in line
    assert "mV/g²" in line


def test_before_and_after_are_printed_side_by_side(looped):
    ran, document = looped("k_xx")

    (line,) = lines_with(ran.out, "residual, r.m.s.")
    before, after = (document[model]["residual_rms_V"] * 1e6 for model in ("declared", "augmented"))
    assert f"{before:.0f} µV" in line
    assert f"{after:.0f}" in line or f"{after:.1f}" in line
    assert len(lines_with(ran.out, "alpha0")) >= 1


def test_the_document_finds_the_effect(looped):
    _, document = looped("k_xx")

    assert document["schema"] == "tumble.loop/1"
    coefficient = document["effects"][0]["coefficients"]["k_xx"]
    assert abs(coefficient["value"] - K_XX) < 3 * coefficient["standard_uncertainty"]


def test_what_cannot_be_told_any_more_is_printed_with_its_reason(looped):
    ran, document = looped("k_xx")

    taken_back = {name for name, found in document["augmented"]["parameters"].items() if found["value"] is None}
    assert {line.split()[1] for line in lines_with(ran.out, "is not identifiable:")} == taken_back


def test_clean_data_is_said_to_be_clean(looped):
    ran, document = looped("clean")

    assert ran.out.startswith("Nothing is left that the scatter of the data does not explain")
    assert (document["effects"], document["unexplained"]) == ([], None)


def test_a_misreading_is_printed_with_its_row(looped):
    ran, document = looped("misread")

    assert f"row {MISREAD_ROW} by 10°" in ran.out
    assert document["effects"][0]["coefficients"] == {"rows": [MISREAD_ROW], "error_deg": [10.0]}


def test_json_on_standard_output_comes_alone(k_xx_csv):
    assert json.loads(tumble("close-loop", k_xx_csv, "--json", "-").out)["schema"] == "tumble.loop/1"


def test_a_stand_file_adds_its_budget(looped, k_xx_csv, write):
    stand = write("b.toml", STAND.replace("[daq]\n", "[daq]\noffset_uncertainty_v = 1e-3\n"))

    document = json.loads(tumble("close-loop", k_xx_csv, "--stand", stand, "--json", "-").out)

    assert document["declared"]["parameters"]["u0"]["standard_uncertainty"] == pytest.approx(1e-3, rel=1e-2)


def test_a_report_is_written_where_it_is_asked_for(k_xx_csv, tmp_path, no_report):
    ran = tumble("close-loop", k_xx_csv, "--serial", "SN-7", "--report", tmp_path / "r" / "page.html")

    assert ran.status == 0
    assert (tmp_path / "r" / "page.html").read_text() == "<html></html>"
    assert f"report {tmp_path / 'r' / 'page.html'}" in ran.err


def test_a_recording_is_read_as_well(calibrated, tmp_path):
    ran = tumble("close-loop", calibrated.recording, "--json", tmp_path / "loop.json")

    document = json.loads((tmp_path / "loop.json").read_text("utf-8"))
    assert ran.status == 0
    assert document == calibrated.document["loop"] | {"verdict": calibrated.document["verdict"]}


def test_a_recording_outside_its_limits_is_status_1(write, tmp_path):
    programme = write("limited.toml", f"{TINY}\n[limits]\nu0 = {{ min = 2.6, max = 2.7 }}\n")
    tumble("run", "--programme", programme, "--serial", "A", "--out", tmp_path / "x.mcap")

    assert tumble("close-loop", tmp_path / "x.mcap").status == 1


def test_a_table_without_a_voltage_is_bad_input(write):
    ran = tumble("fit", write("t.csv", "angle_deg,reference_deg\n0,0\n90,90\n180,180\n"))

    assert ran.status == 2
    assert "there is no column voltage_V" in ran.complaint


def test_a_file_that_is_not_there_is_bad_input(tmp_path):
    assert tumble("close-loop", tmp_path / "nothing.csv").status == 2


def test_calibrate_closes_the_loop_and_says_so(calibrated):
    loop = calibrated.document["loop"]

    assert loop["schema"] == "tumble.loop/1"
    assert loop["declared"]["parameters"]["kx"]["value"] == calibrated.document["parameters"]["kx"]["value"]
    assert "the scatter of the data" in calibrated.ran.out or "was traced to" in calibrated.ran.out


def test_a_calibration_is_stored_and_reported_with_its_loop(calibrated):
    record = calibrated.document["record"]
    exported = json.loads(tumble("records", "export", record, "--store", calibrated.store).out)
    (page,) = calibrated.store.glob("reports/*.html")

    assert exported["result"]["loop"] == calibrated.document["loop"]
    assert "What the model left unexplained" in page.read_text("utf-8")


def test_a_record_with_its_loop_is_verified(calibrated, monkeypatch):
    monkeypatch.setattr("tumble.app.methods.dividing_head.job.explain_questioned", explain_questioned)
    ran = tumble("records", "verify", "--store", calibrated.store)

    assert (ran.status, "every parameter comes back" in ran.out) == (0, True)


def test_a_record_shows_the_parameters_with_what_was_found(k_xx_csv, tmp_path):
    record = json.loads(tumble("fit", k_xx_csv, "--store", tmp_path / "s", "--json", "-").out)["record"]

    lines = tumble("records", "show", record, "--store", tmp_path / "s").out.splitlines()

    assert "with k_xx" in lines
    assert len([line for line in lines if line.startswith("  ky ")]) == 2


def probe_table(realisations=1):
    """The unit of `k_xx_table` in another mount that parts k_xx from what stays with the head."""
    return table(("sweep", "face-up-90", range(0, 360, 15)), realisations=realisations, extra_v=k_xx, seed=9)


def test_a_table_and_the_experiment_after_it_are_traced_together(k_xx_csv, tmp_path):
    write_table(probe_table(), tmp_path / "probe.csv")

    ran = tumble("close-loop", k_xx_csv, tmp_path / "probe.csv", "--json", tmp_path / "loop.json")

    document = json.loads((tmp_path / "loop.json").read_text("utf-8"))
    assert (ran.status, document["rows"]["read"]) == (0, 162 + 24)
    (effect,) = document["effects"]
    assert effect["name"] == "k_xx"
    assert "head_eccentricity" not in effect["also_possible"]
    assert f"rows 1 to 162 from {k_xx_csv} and 163 to 186 from {tmp_path / 'probe.csv'}" in "".join(
        document["warnings"]
    )


def test_two_recordings_of_one_unit_are_traced_together(tiny_recording, tiny, tmp_path):
    tumble("run", "--programme", tiny, "--serial", "SN-7", "--out", tmp_path / "again.mcap")

    ran = tumble("close-loop", tiny_recording, tmp_path / "again.mcap", "--json", "-")

    assert (ran.status, json.loads(ran.out)["rows"]["read"]) == (0, 12)


def test_recordings_of_two_units_are_refused(tiny_recording, tiny, tmp_path):
    tumble("run", "--programme", tiny, "--serial", "SN-8", "--out", tmp_path / "other.mcap")

    ran = tumble("close-loop", tiny_recording, tmp_path / "other.mcap")

    assert ran.status == 2
    assert ran.complaint == (
        f"{tmp_path / 'other.mcap'}: holds unit SN-8, but {tiny_recording} holds unit SN-7; give only files of one unit"
    )


def test_a_file_that_is_given_twice_is_refused(k_xx_csv):
    ran = tumble("close-loop", k_xx_csv, k_xx_csv)

    assert ran.status == 2
    assert ran.complaint == f"{k_xx_csv}: holds the same as {k_xx_csv}; give every file once"


def test_a_question_about_one_of_the_files_comes_before_any_tracing(k_xx_csv, tmp_path):
    rows = probe_table(realisations=2)
    write_table(replace(rows, angle_deg=np.deg2rad(rows.angle_deg)), tmp_path / "radians.csv")

    ran = tumble("close-loop", k_xx_csv, tmp_path / "radians.csv")

    assert ran.status == 2
    assert "are these radians?" in ran.complaint


def test_a_report_names_all_files_that_it_rests_on(k_xx_csv, tmp_path):
    write_table(probe_table(), tmp_path / "probe.csv")

    measurement = read_together([k_xx_csv, tmp_path / "probe.csv"])

    sources = provenance(measurement).sources
    assert [source.path for source in sources] == [str(k_xx_csv.resolve()), str((tmp_path / "probe.csv").resolve())]
    assert [len(source.sha256) for source in sources] == [64, 64]


def test_without_a_file_there_is_nothing_to_trace():
    assert tumble("close-loop").status == 2
