"""The verdict of every command that has limits: alike on terminal, in JSON, record and exit status."""

import json
import shutil

import pytest
from app_jobs import STAND, TINY, cheaply, tumble

from tumble.calibrations.records.store import Store

SEED = """\
name = "short-seed"
realisations = 3
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "flip"
axes = ["x", "y", "z"]
pole = "nominal"

[[procedure]]
kind = "sweep"
mount = "face-up"
step_deg = 15.0
points = 24

[limits]
ky = { min = -0.03, max = 0.03 }
"""
"""The published method in short: alpha0 and ky rest on the curvature kxy."""


K_XX = "{ k_xx = 2e-3 }"


def stand_with(write, effects, parameters="{}"):
    text = f"{STAND}noise_v = 3e-4\neffects = {effects}\nparameters = {parameters}\n"
    return write("bench-1.toml", text)


@pytest.fixture
def k_xx_stand(write):
    """A good unit with an undeclared k_xx, which puts the declared ky at half a volt per g."""
    return stand_with(write, K_XX)


@pytest.fixture(scope="module")
def calibrated_k_xx(tmp_path_factory, traced_once):
    """`tumble calibrate` of that unit; the run, its JSON and the store, to be looked at only."""
    folder = tmp_path_factory.mktemp("k_xx")

    def write(name, text):
        (folder / name).write_text(text, "utf-8")
        return folder / name

    with cheaply():
        ran = tumble(
            "calibrate", "--stand", stand_with(write, K_XX), "--programme", write("p.toml", SEED), "--serial", "A",
            "--store", folder / "store", "--json", folder / "result.json",
        )  # fmt: skip
    return ran, json.loads((folder / "result.json").read_text("utf-8")), folder / "store"


def test_what_the_loop_withdraws_decides_nothing_in_any_command(calibrated_k_xx, tmp_path):
    ran, document, store = calibrated_k_xx
    (recording,) = shutil.copytree(store, tmp_path / "store").glob("recordings/A/*.mcap")

    fitted, closed = (tumble(command, recording, "--json", "-") for command in ("fit", "close-loop"))
    resumed = tumble("resume", recording, "--json", "-")

    verdicts = [document["verdict"], *(json.loads(each.out)["verdict"] for each in (fitted, closed, resumed))]
    assert [(each["outcome"], each["judged"]) for each in verdicts] == [("not_decided", "augmented")] * 4
    assert [each.status for each in (ran, fitted, closed, resumed)] == [1] * 4
    assert verdicts[0]["parameters"][0]["reason"].startswith("no value: it differs between k_xx and")


def test_what_the_loop_withdraws_is_never_the_headline(calibrated_k_xx):
    ran, document, store = calibrated_k_xx

    assert document["loop"]["declared"]["parameters"]["ky"]["value"] > 0.3
    assert (document["model"], document["parameters"]["ky"]["value"]) == ("augmented", None)
    assert "ky" not in document["per_m_s2"]
    rows = {line.split("│")[1].strip(): line for line in ran.out.splitlines() if line.count("│") == 6}
    assert "not identifiable" in rows["ky"]
    assert "NOT DECIDED" in rows["ky"]
    assert ran.out.startswith("verdict: NOT DECIDED (judged: the augmented model)")
    (record,) = Store.existing(store).find()
    assert record.values["ky"].value is None


def test_a_record_keeps_and_shows_the_verdict_and_the_values_to_use(calibrated_k_xx):
    _, document, store = calibrated_k_xx

    shown = tumble("records", "show", document["record"], "--store", store).out
    exported = json.loads(tumble("records", "export", document["record"], "--store", store).out)
    listed = tumble("records", "list", "--store", store, "--verdict", "not_decided").out

    lines = shown.splitlines()
    assert lines[0].endswith("revision 1, not decided")
    assert next(line for line in lines if line.startswith("  ky  ")).startswith("  ky     not identifiable: it differs")
    assert lines.index("of the declared model alone, which does not describe these data:") > lines.index("with k_xx")
    assert exported["verdict"] == document["verdict"]
    assert "not decided" in listed
    assert document["record"] in listed


def test_a_comparison_does_not_compare_what_a_loop_withdrew(calibrated_k_xx):
    _, document, store = calibrated_k_xx

    said = tumble("records", "compare", document["record"], document["record"], "--store", store).out

    assert "ky cannot be compared: the first record has no value (it differs between k_xx" in said


def test_a_bad_unit_does_not_pass_where_nothing_was_traced(write, tmp_path):
    stand = stand_with(write, "{ k_xx = -1e-4 }", "{ ky = 0.06 }")
    recording = tmp_path / "x.mcap"
    tumble("run", "--stand", stand, "--programme", write("p.toml", SEED), "--serial", "A", "--out", recording)

    ran = tumble("fit", recording, "--json", "-")

    decided = json.loads(ran.out)["verdict"]
    assert (ran.status, decided["outcome"], decided["judged"]) == (1, "not_decided", "declared")
    assert "probe-face-down" in decided["parameters"][0]["remedy"]


def test_a_programme_without_limits_is_good_and_says_so(tiny_recording):
    ran = tumble("fit", tiny_recording, "--json", "-")

    document = json.loads(ran.out)
    assert ran.status == 0
    assert document["verdict"]["outcome"] == "no_limits"
    assert document["verdict"]["parameters"] == []
    assert "loop" not in document


def test_a_unit_inside_its_limits_passes_and_the_terminal_says_what_was_judged(write, tmp_path):
    programme = write("p.toml", f"{TINY}\n[limits]\nu0 = {{ min = 2.4, max = 2.6 }}\n")
    tumble("run", "--programme", programme, "--serial", "A", "--out", tmp_path / "x.mcap")

    for command in ("fit", "close-loop"):
        ran = tumble(command, tmp_path / "x.mcap")
        assert ran.status == 0
        assert "verdict: PASS (judged: the declared model)" in ran.out


def test_the_acting_loop_judges_too(k_xx_stand, write, tmp_path):
    ran = tumble(
        "close-loop", "--stand", k_xx_stand, "--programme", write("p.toml", SEED), "--serial", "A",
        "--store", tmp_path / "s", "--experiments", "0", "--json", "-",
    )  # fmt: skip

    assert ran.status == 1
    assert json.loads(ran.out)["verdict"]["outcome"] == "not_decided"
