import json
import re

import numpy as np
import pytest
from app_jobs import tumble
from head_tables import rests, stream
from public_heads import backwards, five_settings, joint

from tumble.calibrations.core.table import write_table


def closed(tmp_path, *paths):
    ran = tumble("close-loop", *paths, "--json", tmp_path / "loop.json")
    assert ran.status == 0, ran.err
    return ran, json.loads((tmp_path / "loop.json").read_text("utf-8"))


def named(document):
    return [effect["name"] for effect in document["effects"]]


@pytest.fixture
def eccentric(tmp_path):
    write_table(rests(lambda a, d, t: 0.02 * np.sin(np.deg2rad(a))), tmp_path / "head.csv")
    return tmp_path / "head.csv"


def test_a_head_against_a_reference_is_traced_with_the_same_command(tmp_path, eccentric):
    ran, document = closed(tmp_path, eccentric)
    assert "traced to head_eccentricity" in ran.out
    assert document["schema"] == "tumble.loop/1"
    assert named(document) == ["head_eccentricity"]
    assert document["declared"]["residual_rms_deg"] > 10 * document["augmented"]["residual_rms_deg"]
    assert document["unexplained"] is None


def test_two_tables_of_one_head_are_compared(tmp_path, eccentric):
    write_table(rests(lambda a, d, t: 0 * a), tmp_path / "mended.csv")
    ran, document = closed(tmp_path, eccentric, tmp_path / "mended.csv")
    (change,) = document["changed"]
    assert (change["name"], change["after"]) == ("head_eccentricity", 0.0)
    assert change["difference"] == pytest.approx(0.02, abs=5e-4)
    assert change["before"] == pytest.approx(0.02, abs=5e-4)
    assert "What the difference shows" in ran.out


def test_the_report_of_a_table_that_is_recorded_says_the_change_since_the_last_one(tmp_path):
    told = []
    for year in ("one", "two"):
        (tmp_path / year).mkdir()
        table, page = tmp_path / year / "head.csv", tmp_path / f"{year}.html"
        write_table(rests(lambda a, d, t: 0 * a, seed=len(told)), table)
        ran = tumble("close-loop", table, "--record", "--store", tmp_path / "store", "--report", page)
        assert ran.status == 0, ran.err
        told.append(re.findall(r"\([+-][^)]*±[^)]*\) ° since \d{4}-\d\d-\d\d", page.read_text("utf-8")))
    assert not told[0]
    assert told[1]


def test_an_eccentricity_that_turned_round_has_changed(tmp_path, eccentric):
    write_table(rests(lambda a, d, t: -0.02 * np.sin(np.deg2rad(a))), tmp_path / "turned.csv")
    _, document = closed(tmp_path, eccentric, tmp_path / "turned.csv")
    (change,) = document["changed"]
    assert change["difference"] == pytest.approx(0.04, abs=1e-3)


def test_where_nothing_changed_that_is_said(tmp_path, eccentric):
    write_table(rests(lambda a, d, t: 0.02 * np.sin(np.deg2rad(a)), seed=2), tmp_path / "again.csv")
    ran, document = closed(tmp_path, eccentric, tmp_path / "again.csv")
    assert document["changed"] == []
    assert "Nothing changed beyond its uncertainty" in ran.out


def test_a_head_table_of_one_row_is_too_short_and_says_so(tmp_path):
    (tmp_path / "one.csv").write_text("angle_deg,reference_deg\n0,0.1\n", "utf-8")
    ran, document = closed(tmp_path, tmp_path / "one.csv")
    assert document["declared"]["held_out_rms_deg"] is None
    assert "1 row is too few; at least 6 are needed" in ran.err


def test_no_experiment_can_be_run_from_a_head_table(eccentric):
    ran = tumble("close-loop", eccentric, "--experiments", 2, "--serial", "A")
    assert ran.status == 2
    assert "leave --experiments out" in ran.err


def test_rows_that_are_set_aside_are_listed(tmp_path):
    table = rests(lambda a, d, t: 0.1 * (np.arange(len(a)) == 40))
    write_table(table, tmp_path / "wild.csv")
    ran, _ = closed(tmp_path, tmp_path / "wild.csv")
    assert "set aside: rows 41 (gross error)" in ran.out


def test_parameters_against_temperature_are_traced_with_the_same_command(tmp_path):
    lines = [f"{run},{20 + 5 * run},{0.1 * run + 1e-3 * (-1) ** run}" for run in range(1, 13)]
    (tmp_path / "runs.csv").write_text("\n".join(["run,sensor_degC,bias_mV", *lines]), "utf-8")
    ran, document = closed(tmp_path, tmp_path / "runs.csv")
    assert named(document["parameters"]["bias_mV"]) == ["temperature_linear"]
    assert document["cannot_be_known"][0].startswith("Every run was warmer")
    assert "bias_mV" in ran.out


def test_tables_of_different_kinds_are_refused(tmp_path, eccentric):
    (tmp_path / "runs.csv").write_text("run,sensor_degC,bias_mV\n1,20,3\n", "utf-8")
    ran = tumble("close-loop", eccentric, tmp_path / "runs.csv")
    assert ran.status == 2
    assert "different kinds" in ran.err


def test_a_malformed_table_of_runs_ends_with_one_sentence(tmp_path):
    (tmp_path / "runs.csv").write_text("run,sensor_degC,bias_mV\n1,20,3\n2,30,x\n", "utf-8")
    ran = tumble("close-loop", tmp_path / "runs.csv")
    assert (ran.status, ran.err.count("\n")) == (2, 1)
    assert "line 3, column bias_mV: 'x' is not a number" in ran.err


def test_a_reference_that_counts_backwards_is_asked_about_and_nothing_else_is_stated(tmp_path):
    write_table(backwards(), tmp_path / "back.csv")
    page = tmp_path / "back.html"
    ran = tumble("close-loop", tmp_path / "back.csv", "--report", page)
    assert ran.status == 0
    assert "it turns against the head; change its sign" in " ".join(ran.err.split())
    assert ran.out.strip() == "Nothing is stated before that is answered."
    text = page.read_text("utf-8")
    assert "change its sign" in text
    assert "Nothing is stated before that is answered." in text
    for stated in ("shows no effect", "Before and after", "What a constant offset leaves"):
        assert stated not in text


def test_too_few_rows_are_said_to_be_too_few_and_nothing_is_stated(tmp_path):
    (tmp_path / "few.csv").write_text("angle_deg,reference_deg\n0,0.1\n90,90.1\n180,180.2\n", "utf-8")
    ran, document = closed(tmp_path, tmp_path / "few.csv")
    assert "Nothing was looked for: 3 rows are too few; at least 6 are needed" in ran.out
    assert "Before and after" not in ran.out
    assert document["declared"]["parameters"]["offset"]["value"] is None
    assert document["declared"]["parameters"]["offset"]["reason"] == "3 rows are too few; at least 6 are needed"


def test_repeats_give_a_table_of_settings_on_the_terminal_and_in_the_report(tmp_path):
    write_table(five_settings(), tmp_path / "five.csv")
    page = tmp_path / "five.html"
    ran = tumble("close-loop", tmp_path / "five.csv", "--verbose", "--report", page)
    assert "F(9, 38) = 497" in ran.out
    for text in (ran.out, page.read_text("utf-8")):
        assert "Error by setting" in text
        assert "0.0320(13)°" in text
        assert "eccentricity" not in text


def test_a_joint_is_compared_as_a_map(tmp_path):
    write_table(joint(loaded=False), tmp_path / "unloaded.csv")
    write_table(joint(loaded=True), tmp_path / "loaded.csv")
    ran, document = closed(
        tmp_path, tmp_path / "unloaded.csv", tmp_path / "loaded.csv", "--report", tmp_path / "p.html"
    )
    assert "loaded.csv minus unloaded.csv" in (tmp_path / "p.html").read_text("utf-8")
    assert "loaded.csv minus unloaded.csv, at 101 angles that both visited" in " ".join(ran.out.split())
    above = [part["mean_deg"] for part in document["difference"]["parts"] if part["direction"] == 1]
    assert -1.2 < min(above) < max(above) < -0.35
    assert document["difference"]["head_changed"]
    assert [round(each["value"], 3) for each in document["difference"]["slopes_deg_per_deg"]] == [0.049, 0.039]


@pytest.mark.parametrize(
    ("header", "said"),
    [
        ("temperature_degC,humidity_percent,time_h", "looks like a table of the climate of a room"),
        ("angle_degs,Voltage_v,temperature_degC", "is angle_degs angle_deg and Voltage_v voltage_V?"),
        ("outer_deg,inner_deg,u_x_V,temperature_degC", "looks like a table of a triad, and it lacks u_y_V and u_z_V"),
    ],
)
def test_a_table_that_is_not_known_is_refused_by_name(tmp_path, header, said):
    width = header.count(",") + 1
    rows = [",".join([str(20 + 5 * row)] * width) for row in range(8)]
    (tmp_path / "log.csv").write_text("\n".join([header, *rows, ""]), "utf-8")
    ran = tumble("close-loop", tmp_path / "log.csv")
    assert (ran.status, ran.out) == (2, "")
    assert said in " ".join(ran.err.split())


def test_two_temperatures_are_too_few_and_nothing_is_stated(tmp_path):
    lines = [f"{run},{20 + 40 * (run % 2)},{0.1 * run}" for run in range(1, 13)]
    (tmp_path / "runs.csv").write_text("\n".join(["run,sensor_degC,bias_mV", *lines, ""]), "utf-8")
    ran, document = closed(tmp_path, tmp_path / "runs.csv")
    assert "2 temperatures (visited 12 times) are too few" in " ".join(ran.out.split())
    assert "Nothing is looked for" in ran.out
    assert document["parameters"]["bias_mV"]["augmented"]["parameters"]["constant"]["value"] is None
    assert tumble("close-loop", tmp_path / "runs.csv", "--report", tmp_path / "runs.html").status == 0


STAND = """
name = "bench-9"
[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]
serial = "H-1"
[daq]
driver = "simulated"
serial = "D-1"
[simulated]
preset = "DXL203EB"
[stand_record]
use = true
"""


def test_a_reference_gives_a_stand_record_that_is_in_force_at_once_and_comes_back(tmp_path, eccentric):
    stand = tmp_path / "bench.toml"
    stand.write_text(STAND, "utf-8")
    store = tmp_path / "store"
    learned = tumble("stand", "learn", eccentric, "--stand", stand, "--store", store)
    assert learned.status == 0, learned.err
    assert "stand record 1 is in force" in learned.out
    shown = tumble("stand", "show", "bench-9", "--store", store)
    assert "head_eccentricity amplitude" in shown.out
    assert "270°    -7" in shown.out  # seconds of arc: 0.02° is 72″
    verified = tumble("stand", "verify", "--store", store)
    assert verified.status == 0, verified.out
    assert "1 of 1 stand record comes back" in verified.out


def test_a_reference_that_shows_nothing_gives_no_record(tmp_path):
    (tmp_path / "bench.toml").write_text(STAND, "utf-8")
    write_table(rests(lambda a, d, t: 0 * a), tmp_path / "good.csv")
    learned = tumble(
        "stand", "learn", tmp_path / "good.csv", "--stand", tmp_path / "bench.toml", "--store", tmp_path / "store"
    )
    assert learned.status == 2
    assert "nothing to put into a stand record" in learned.err


def test_the_head_map_is_in_the_document_and_in_the_report(tmp_path, eccentric):
    page = tmp_path / "head.html"
    assert tumble("close-loop", eccentric, "--report", page, "--json", tmp_path / "head.json").status == 0
    document = json.loads((tmp_path / "head.json").read_text("utf-8"))
    assert document["head_map"]["orders"] == [1]
    assert document["head_map"]["coefficients_deg"][0] == pytest.approx(0.02, abs=5e-4)
    text = page.read_text("utf-8")
    for heading in ("What a constant offset leaves", "To what it was traced", "Before and after", "Head map"):
        assert heading in text


def test_the_report_on_a_head_states_the_expanded_uncertainty_of_its_offset(tmp_path, eccentric):
    page = tmp_path / "head.html"
    assert tumble("close-loop", eccentric, "--report", page, "--json", tmp_path / "head.json").status == 0
    offset = json.loads((tmp_path / "head.json").read_text("utf-8"))["augmented"]["parameters"]["offset"]
    text = re.sub(r"<[^>]+>", " ", page.read_text("utf-8"))
    expanded, unit, factor = re.search(r"± ([\d.]+)\) (\S+)\s+([\d.]+)", text).groups()
    assert (unit, factor) == ("°", "1.98")
    assert float(expanded) == pytest.approx(1.98 * offset["standard_uncertainty"], rel=0.05)


def test_the_report_on_runs_shows_what_is_shared_and_what_cannot_be_told(tmp_path):
    lines = [f"{run},{-30 + 10 * run},{max(0, run - 6) * 2.0 + 0.01 * (-1) ** run}" for run in range(1, 13)]
    (tmp_path / "runs.csv").write_text("\n".join(["run,sensor_degC,bias_mV", *lines]), "utf-8")
    assert tumble("close-loop", tmp_path / "runs.csv", "--report", tmp_path / "runs.html").status == 0
    text = (tmp_path / "runs.html").read_text("utf-8")
    assert "break in the temperature dependence" in text
    assert "constant term; it follows temperature" in text
    assert "What these runs cannot tell" in text


def test_a_stream_of_samples_is_taken_as_dwells(tmp_path):
    write_table(stream(lambda a, d, t: 0 * a, late_s=0.033), tmp_path / "stream.csv")
    _, document = closed(tmp_path, tmp_path / "stream.csv")
    assert document["rows"]["dwells"] == pytest.approx(document["rows"]["used"] / 10, rel=0.1)
