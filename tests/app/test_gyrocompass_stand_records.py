"""What errs in the pickoff of a turntable is stored for it, once two platforms agree, and taken off later runs."""

import json
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from app_jobs import tumble

STAND = (resources.files("tumble.procedures.methods.gyrocompass") / "stand.toml").read_text("utf-8")
PROGRAMME = """method = "gyrocompass"
name = "round"
dwell_s = 20.0

[[procedure]]
positions = "0/30/60/90/120/150/180/210/240/270/300/330/330/300/270/240/210/180/150/120/90/60/30/0"
"""
ERROR = "\n[simulated.effects]\npickoff_second_harmonic = { amplitude_deg = 0.4, phase_deg = 30.0 }\n"
PLATFORMS = ("alpha0_deg = -37.2\n", "alpha0_deg = 101.0\ndrift_deg_h = -1.3\n", "alpha0_deg = 55.0\n")
USE = "\n[stand_record]\nuse = true\n"


@dataclass(frozen=True)
class Bench:
    folder: Path
    runs: tuple

    def document(self, unit):
        return json.loads((self.folder / f"{unit}.json").read_text("utf-8"))


def calibrated(folder, number, text):
    (folder / f"{number}.toml").write_text(text, "utf-8")
    (folder / "round.toml").write_text(PROGRAMME, "utf-8")
    ran = tumble(
        "calibrate", "--stand", folder / f"{number}.toml", "--programme", folder / "round.toml",
        "--serial", f"P{number}", "--store", folder / "store", "--json", folder / f"{number}.json",
    )  # fmt: skip
    assert ran.status == 0, ran.err
    return ran


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    folder = tmp_path_factory.mktemp("turntable")
    stands = [STAND.replace("seed = 1", f"seed = {number}\n{each}") + ERROR for number, each in enumerate(PLATFORMS, 1)]
    runs = [calibrated(folder, number, text + (USE if number == 3 else "")) for number, text in enumerate(stands, 1)]
    return Bench(folder, tuple(runs))


def test_what_one_platform_says_is_provisional_until_another_agrees(bench):
    assert "provisional (stand record 1) until another unit agrees" in bench.runs[0].err
    assert "units P1 and P2 agree" in bench.runs[1].err


def test_a_record_holds_the_error_of_the_pickoff(bench):
    ran = tumble("stand", "show", "simulated-gyro-platform", "--store", bench.folder / "store", "--json", "-")
    (term,) = json.loads(ran.out)["corrections"]["terms"]
    wanted = 0.4 * np.array([np.cos(np.deg2rad(30.0)), np.sin(np.deg2rad(30.0))])
    assert (term["orders"], term["unit"]) == ([2], "deg")
    assert term["coefficients"] == pytest.approx(wanted, abs=0.03)


def test_a_later_platform_is_corrected_and_does_not_show_it(bench):
    assert "corrected by stand record 2" in bench.runs[2].out + bench.runs[2].err
    document = bench.document(3)
    assert document["loop"]["effects"] == []
    alpha0 = document["parameters"]["alpha0"]
    assert abs(alpha0["value"] - 55.0) < 4.0 * alpha0["standard_uncertainty"]
    assert alpha0["standard_uncertainty"] > alpha0["type_a"]


def test_stand_records_come_back_from_their_raw_files(bench):
    assert "2 of 2 stand records come back" in tumble("stand", "verify", "--store", bench.folder / "store").out


def test_a_turntable_that_has_changed_contradicts_its_record(bench):
    changed = STAND.replace("seed = 1", "seed = 7") + ERROR.replace("0.4", "0.9") + USE
    ran = calibrated(bench.folder, 4, changed)
    assert "stand record 2 says head_second_harmonic amplitude 0.4" in ran.err
