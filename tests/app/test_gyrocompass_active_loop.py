"""The loop acts on a gyro platform: it leans the base and takes further positions, at its simulated stand."""

import json
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from app_jobs import tumble

from tumble.app.measurements import read_measurement
from tumble.app.methods.gyrocompass.experiments import available, renewed
from tumble.app.stand import load_stand
from tumble.calibrations.methods.gyrocompass.observations import read_gyrocompass_table

STAND = (resources.files("tumble.procedures.methods.gyrocompass") / "stand.toml").read_text("utf-8")
EFFECT = "\n[simulated.effects]\npickoff_second_harmonic = { amplitude_deg = 0.3, phase_deg = 40 }\n"
FIRST = """method = "gyrocompass"
name = "first"
dwell_s = 10.0

[[procedure]]
positions = "0/90/180/270"
repeats = 6
"""
ROWS = "time_s,azimuth_deg,latitude_deg,rate_deg_h,base\n0,0,50,1,1\n20,90,50,2,{last}\n"


@dataclass(frozen=True)
class Done:
    folder: Path
    document: dict


@pytest.fixture(scope="module")
def told_apart(tmp_path_factory):
    folder = tmp_path_factory.mktemp("told")
    (folder / "s.toml").write_text(STAND + EFFECT, "utf-8")
    (folder / "first.toml").write_text(FIRST, "utf-8")
    ran = tumble(
        "close-loop", "--stand", folder / "s.toml", "--programme", folder / "first.toml", "--serial", "G1",
        "--store", folder / "store", "--json", folder / "loop.json",
    )  # fmt: skip
    assert ran.status == 0, ran.err
    return Done(folder, json.loads((folder / "loop.json").read_text("utf-8")))


def test_an_error_of_the_pickoff_is_told_from_its_rivals(told_apart):
    (effect,) = told_apart.document["effects"]
    assert (effect["name"], effect["also_possible"]) == ("pickoff_second_harmonic", [])
    amplitude = effect["coefficients"]["amplitude_deg"]
    assert abs(amplitude["value"] - 0.3) < 4.0 * amplitude["standard_uncertainty"]
    assert told_apart.document["ended"]["how"] == "told apart"


def test_the_heading_is_that_of_the_simulated_platform(told_apart):
    alpha0 = told_apart.document["augmented"]["parameters"]["alpha0"]
    assert abs(alpha0["value"] + 37.2) < 4.0 * alpha0["standard_uncertainty"]


def test_what_comes_after_another_lean_is_taken_on_it(told_apart):
    files = sorted(told_apart.folder.glob("store/recordings/G1/*.mcap"))
    bases = [np.unique(read_measurement(path).observations.base).tolist() for path in files]
    leaned = bases.index([2])
    assert leaned and bases == [[1]] * leaned + [[2]] * (len(bases) - leaned)
    assert len(bases) > leaned + 1


def offers_after(tmp_path, last):
    (tmp_path / "s.toml").write_text(STAND, "utf-8")
    (tmp_path / "t.csv").write_text(ROWS.format(last=last), "utf-8")
    rows = read_gyrocompass_table(tmp_path / "t.csv")
    return available(load_stand(tmp_path / "s.toml"), rows), rows


@pytest.mark.parametrize(("last", "asked", "another"), [(1, None, 2), (2, 2, 3)])
def test_another_lean_is_a_new_number_and_all_else_stays_on_the_last(last, asked, another, tmp_path):
    found, rows = offers_after(tmp_path, last)
    for offers in (found.offers, renewed(found, rows).offers):
        bases = {offer.programme.name: offer.programme.parts[0].base for offer in offers}
        assert bases == {
            **dict.fromkeys(["0-120-240", "0-180-90-270", "0-90-180-90-0", "every-30"], asked),
            "another-lean": another,
        }
        assert [offer.needs for offer in offers if offer.probe.leans] == [{"base": str(another)}]


def test_positions_beyond_the_limits_of_the_turntable_are_not_offered(tmp_path):
    (tmp_path / "s.toml").write_text(STAND.replace("370.0]", "200.0]"), "utf-8")
    (tmp_path / "t.csv").write_text(ROWS.format(last=1), "utf-8")
    found = available(load_stand(tmp_path / "s.toml"), read_gyrocompass_table(tmp_path / "t.csv"))
    assert [offer.programme.name for offer in found.offers] == ["0-90-180-90-0"]
    assert "outside the azimuth's limits of -10 to 200 deg" in found.refused["0-120-240"][1]


def test_every_probe_is_two_passes_of_the_programme_that_comes_along(tmp_path):
    found, _ = offers_after(tmp_path, 1)
    for offer in found.offers:
        (positions,) = offer.programme.parts
        assert positions.positions * positions.repeats == offer.probe.azimuths_deg
        assert positions.repeats == 2
