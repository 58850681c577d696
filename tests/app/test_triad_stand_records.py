"""What errs in the two axes is stored for them, once two units agree, and taken off later runs."""

import json
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from app_jobs import tumble

from tumble.app.stand_records import identity_of_stand

STAND = (resources.files("tumble.procedures.methods.triad") / "stand.toml").read_text("utf-8")
EFFECTS = """
[simulated.effects]
inner_eccentricity = { amplitude_arcsec = 40.0, phase_deg = 30.0 }
axes_orthogonality = { value_arcsec = 30.0 }

[simulated.parameters]
"""
UNITS = ("", "bias_x = 0.004\nm_xy = 10.0\n", "scale_z = 1.01\n\n[stand_record]\nuse = true\n")


@dataclass(frozen=True)
class Bench:
    folder: Path
    runs: tuple

    def document(self, unit):
        return json.loads((self.folder / f"{unit}.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    folder = tmp_path_factory.mktemp("axes")
    runs = []
    for number, unit in enumerate(UNITS, start=1):
        stand = folder / f"{number}.toml"
        stand.write_text(STAND.replace("seed = 1", f"seed = {number}") + EFFECTS + unit, "utf-8")
        runs.append(
            tumble(
                "calibrate",
                "--stand",
                stand,
                "--programme",
                "24-there-and-back",
                "--serial",
                f"U{number}",
                "--store",
                folder / "store",
                "--json",
                folder / f"{number}.json",
            )
        )
        assert runs[-1].status == 0, runs[-1].err
    return Bench(folder, tuple(runs))


def test_what_one_unit_says_of_the_axes_is_provisional(bench):
    assert "provisional (stand record 1) until another unit agrees" in bench.runs[0].err


def test_what_two_units_agree_on_is_in_force(bench):
    assert "units U1 and U2 agree" in bench.runs[1].err
    assert "stand record 2 is in force" in bench.runs[1].err


def test_a_record_holds_the_errors_of_each_axis_in_arc_seconds(bench):
    ran = tumble("stand", "show", "simulated-two-axes", "--store", bench.folder / "store", "--json", "-")
    assert ran.status == 0, ran.err
    terms = {each["effect"]: each for each in json.loads(ran.out)["corrections"]["terms"]}
    assert terms["axes_orthogonality"]["unit"] == "arcsec"
    assert terms["axes_orthogonality"]["coefficients"] == pytest.approx([30.0], abs=1.0)
    wanted = 40.0 * np.array([np.cos(np.deg2rad(30.0)), np.sin(np.deg2rad(30.0))])
    assert terms["inner_eccentricity"]["coefficients"] == pytest.approx(wanted, abs=1.0)


def test_a_later_unit_is_corrected_and_shows_neither_error(bench):
    assert "corrected by stand record 2" in bench.runs[2].out + bench.runs[2].err
    assert bench.document(3)["loop"]["effects"] == []
    scale = bench.document(3)["parameters"]["scale_z"]
    assert abs(scale["value"] - 1.01) < 4.0 * scale["standard_uncertainty"]


def test_what_the_record_does_not_know_is_in_the_uncertainty(bench):
    """The corrected parameters that the errors of the axes move: m_yz and m_xz by the angle between them."""
    parameters = bench.document(3)["parameters"]
    scatter, combined = parameters["m_yz"]["type_a"], parameters["m_yz"]["standard_uncertainty"]
    assert combined > scatter
    assert combined == pytest.approx(np.hypot(scatter, 0.1), abs=0.1)


def test_a_record_belongs_to_both_axes_and_their_sampler(bench):
    ran = tumble("stand", "show", "simulated-two-axes", "--store", bench.folder / "store", "--json", "-")
    identity = json.loads(ran.out)["identity"]
    assert identity["head"].startswith("inner simulated")
    assert "outer simulated" in identity["head"]
    assert identity["daq"].startswith("triad simulated")


def test_stand_records_come_back_from_their_raw_files(bench):
    ran = tumble("stand", "verify", "--store", bench.folder / "store")
    assert ran.status == 0, ran.err
    assert "2 of 2 stand records come back" in ran.out


def test_the_corrected_calibration_verifies(bench):
    ran = tumble("records", "verify", "--store", bench.folder / "store")
    assert ran.status == 0, ran.err


def test_a_stand_that_has_changed_contradicts_its_record(bench):
    stand = bench.folder / "changed.toml"
    changed = (STAND + EFFECTS + UNITS[2]).replace("value_arcsec = 30.0", "value_arcsec = 50.0")
    stand.write_text(changed, "utf-8")
    ran = tumble(
        "calibrate", "--stand", stand, "--programme", "24-there-and-back", "--serial", "U4",
        "--store", bench.folder / "store",
    )  # fmt: skip
    assert ran.status == 0, ran.err
    assert "stand record 2 says axes_orthogonality 30" in ran.err
    assert "this run says axes_orthogonality 5" in ran.err


def test_a_stand_whose_axes_changed_places_is_another_stand():
    stand = {"name": "table", "positioners": {"outer": {"driver": "zaber"}, "inner": {"driver": "zaber"}}}

    as_built, exchanged = (
        identity_of_stand(stand, {"outer": outer, "inner": inner}) for outer, inner in (("51", "52"), ("52", "51"))
    )

    assert as_built.head == "inner zaber 52, outer zaber 51"
    assert exchanged != as_built


def test_the_record_names_each_simulated_axis(bench):
    told = tumble("stand", "list", "--store", bench.folder / "store").out

    assert "SIM-INNER" in told
    assert "SIM-OUTER" in told
