import json
import shlex
import signal

import pytest
from app_jobs import STAND, at_call, tumble

from tumble.drivers.simulated.head import SimulatedHead
from tumble.procedures.recording.reader import read_recording

K_XX = "effects = { k_xx = 6e-4 }\nnoise_v = 1e-3\n"
FIRST = """\
name = "first"
realisations = 2
dwell_s = 1.0

[[procedure]]
kind = "flip"
axes = ["x", "y", "z"]

[[procedure]]
kind = "sweep"
step_deg = 10.0
points = 36
"""
RIVALS = {"k_xx", "k_yy", "k_zz", "axis_tilt", "head_eccentricity"}


class Bench:
    """A stand whose unit has a k_xx, a first programme that cannot tell it, and a store."""

    def __init__(self, folder, head="", answers=""):
        self.folder, self.store, self.json = folder, folder / "store", folder / "loop.json"
        self.stand, self.first, self.answers = folder / "s.toml", folder / "first.toml", folder / "answers.toml"
        self.stand.write_text(STAND.replace("[daq]\n", f"{head}\n[daq]\n") + K_XX, "utf-8")
        self.first.write_text(FIRST, "utf-8")
        self.answers.write_text(answers or '[mounts]\ndefault = "yes"\n', "utf-8")

    def close_loop(self, *arguments):
        return tumble(
            "close-loop", "--stand", self.stand, "--serial", "SN-1", "--programme", self.first, "--store", self.store,
            "--json", self.json, "--answers", self.answers, *arguments,
        )  # fmt: skip

    @property
    def document(self):
        return json.loads(self.json.read_text("utf-8"))

    @property
    def recordings(self):
        return sorted(self.store.glob("recordings/SN-1/*.mcap"))


@pytest.fixture(scope="module")
def told_apart(tmp_path_factory, traced_once):
    bench = Bench(tmp_path_factory.mktemp("told"))
    ran = bench.close_loop()
    assert ran.status == 0, ran.err
    return bench, ran


def test_the_cheapest_experiment_is_run_and_tells_the_right_name(told_apart):
    bench, _ = told_apart
    (experiment,) = bench.document["experiments"]
    (effect,) = bench.document["effects"]
    assert experiment["programme"] == "probe-end"
    assert set(experiment["separated"]) >= RIVALS
    assert experiment["separated"][0] == "k_xx"
    assert (effect["name"], effect["also_possible"]) == ("k_xx", [])
    assert bench.document["ended"]["how"] == "told apart"


def test_what_was_expected_of_an_experiment_stands_beside_what_came(told_apart):
    (experiment,) = told_apart[0].document["experiments"]
    assert experiment["expected_difference"] > 16
    assert 0.3 < experiment["realised_difference"] / experiment["expected_difference"] < 10
    assert set(experiment["rivals_before"]) >= RIVALS
    assert experiment["rivals_after"] == ["k_xx"]
    before_v, after_v = experiment["held_out_rms_V"]
    assert 0 < after_v < 2 * before_v


def test_the_terminal_says_what_is_run_why_and_what_it_decides(told_apart):
    _, ran = told_apart
    assert "k_xx is found, which could as well be " in ran.err
    assert "next: probe-end takes ax away and leaves ay and az: k_xx then differs from" in ran.err
    assert "probe-end decides against" in ran.err
    assert "Everything that was found is told apart." in ran.err


def test_every_run_leaves_a_recording_that_names_those_before_it(told_apart):
    bench, _ = told_apart
    first, probe = bench.recordings
    assert read_recording(first).header.follows == ()
    assert read_recording(probe).header.follows == (str(first),)
    assert bench.document["experiments"][0]["recording"] == str(probe)


def test_a_simulated_stand_goes_on_from_one_run_to_the_next(told_apart):
    first, probe = (read_recording(path) for path in told_apart[0].recordings)
    assert probe.header.started_monotonic_s > first.points[-1].time_s
    assert probe.points[0].readings["voltage_v"].mean != first.points[0].readings["voltage_v"].mean


def test_experiments_that_were_run_are_taken_up_from_their_files(told_apart, tmp_path):
    bench, _ = told_apart
    document = tmp_path / "again.json"
    ran = tumble(
        "close-loop", *bench.recordings, "--stand", bench.stand, "--serial", "SN-1", "--experiments", 3,
        "--store", tmp_path / "other", "--json", document,
    )  # fmt: skip
    again = json.loads(document.read_text("utf-8"))
    assert ran.status == 0
    assert [each["separated"] for each in again["experiments"]] == [bench.document["experiments"][0]["separated"]]
    assert again["effects"] == bench.document["effects"]
    assert not (tmp_path / "other" / "recordings").exists()


def test_an_experiment_after_files_is_of_their_lot(tmp_path):
    bench = Bench(tmp_path)
    assert bench.close_loop("--experiments", 0, "--lot", "L 26/3").status == 0
    ran = bench.close_loop(*bench.recordings, "--experiments", 1)
    _, probe = bench.recordings
    assert ran.status == 0, ran.err
    assert read_recording(probe).header.lot == "L 26/3"


def test_where_the_seat_forbids_what_would_help_that_is_said(tmp_path):
    bench = Bench(tmp_path, head='mounts = ["face-up", "face-down", "edge"]')
    ran = bench.close_loop()
    ended = bench.document["ended"]
    assert (ran.status, ended["how"]) == (0, "no available experiment")
    assert "No experiment that can be run here tells k_xx from head_eccentricity" in ended["why"]
    assert "probe-face-up-90 would tell k_xx from head_eccentricity, but it cannot be run here" in ended["why"]
    assert "the sweep needs the mount face-up-90, and the seat allows face-up, face-down, edge only" in ended["why"]
    assert bench.document["effects"][0]["also_possible"] == ["head_eccentricity"]


def test_a_mount_that_the_operator_declines_is_planned_without(tmp_path):
    bench = Bench(tmp_path, answers='[mounts]\ndefault = "yes"\nend = "no"\n')
    ran = bench.close_loop("--experiments", 1)
    (experiment,) = bench.document["experiments"]
    assert ran.status == 0
    assert "the operator does not seat the unit in end; it is planned without that" in ran.err
    assert experiment["programme"] != "probe-end"
    assert "k_xx" in experiment["separated"]


def test_no_more_experiments_are_run_than_are_asked_for(tmp_path):
    bench = Bench(tmp_path)
    assert bench.close_loop("--experiments", 0).status == 0
    assert bench.document["experiments"] == []
    assert bench.document["ended"] == {
        "how": "as many as were asked for",
        "why": "0 experiments were to be run at most; the next would be probe-end.",
    }
    assert len(bench.recordings) == 1


def test_a_loop_that_is_cut_off_is_resumed_and_gone_on_with(told_apart, tmp_path, monkeypatch):
    bench = Bench(tmp_path)
    with monkeypatch.context() as patched:
        at_call(patched, SimulatedHead, "start_move", 140, _interrupt, last=140)
        cut = bench.close_loop()
    (goes_on,) = [line for line in cut.err.splitlines() if "the loop goes on" in line]
    words = shlex.split(goes_on.partition("tumble ")[2])
    first, probe = bench.recordings
    assert (cut.status, words[:3]) == (4, ["close-loop", str(first), str(probe)])

    assert tumble("resume", probe).status == 0
    ran = tumble(*words, "--store", bench.store, "--json", bench.json)

    assert ran.status == 0, ran.err
    (experiment,), (uncut,) = (each.document["experiments"] for each in (bench, told_apart[0]))
    assert experiment["separated"] == uncut["separated"]
    assert experiment["realised_difference"] == pytest.approx(uncut["realised_difference"], rel=1e-6)
    assert bench.document["ended"]["how"] == "told apart"


def _interrupt():
    signal.raise_signal(signal.SIGINT)


def test_a_stand_needs_a_serial_number():
    ran = tumble("close-loop", "--experiments", 1)
    assert (ran.status, ran.complaint) == (2, "--serial: give the unit's serial number, 1 to 100 characters")


def test_a_first_measurement_that_nobody_answers_is_bad_input(tmp_path):
    bench = Bench(tmp_path, answers="[mounts]\n")
    ran = bench.close_loop()
    assert ran.status == 2
    assert "the loop goes on" not in ran.err


def test_files_of_another_unit_are_refused_before_anything_moves(tiny_recording, tmp_path):
    ran = tumble("close-loop", tiny_recording, "--serial", "SN-8", "--experiments", 1, "--store", tmp_path / "s")
    assert ran.status == 2
    assert f"{tiny_recording}: holds unit SN-7, and SN-8 is to be measured" in ran.err
    assert not (tmp_path / "s").exists()
