"""The loop acts on a triad: it runs the positions that tell rivals apart, at its simulated stand."""

import json
import re
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import pytest
from app_jobs import tumble

from tumble.app.methods.triad.experiments import available
from tumble.app.stand import load_stand
from tumble.calibrations.methods.triad.observations import read_triad_table
from tumble.procedures.recording.reader import read_recording

STAND = (resources.files("tumble.procedures.methods.triad") / "stand.toml").read_text("utf-8")
EFFECT = '\n[simulated.effects]\n"x.scale_asymmetry" = 6e-4\n'
FIRST = """method = "triad"
name = "first"
realisations = 2
dwell_s = 1.0

[[procedure]]
list = "12"
"""


@dataclass(frozen=True)
class Done:
    ran: object
    folder: Path

    @property
    def document(self):
        return json.loads((self.folder / "loop.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def told_apart(tmp_path_factory):
    folder = tmp_path_factory.mktemp("told")
    (folder / "s.toml").write_text(STAND + EFFECT, "utf-8")
    (folder / "first.toml").write_text(FIRST, "utf-8")
    ran = tumble(
        "close-loop", "--stand", folder / "s.toml", "--programme", folder / "first.toml", "--serial", "T1",
        "--store", folder / "store", "--json", folder / "loop.json", "--report", folder / "loop.html",
    )  # fmt: skip
    assert ran.status == 0, ran.err
    return Done(ran, folder)


def test_what_the_edges_leave_open_is_told_apart_by_an_experiment(told_apart):
    (link,) = told_apart.document["experiments"]
    assert {"x.k_xx", "x.scale_asymmetry"} <= set(link["rivals_before"])
    assert link["rivals_after"] == ["x.scale_asymmetry"]
    assert told_apart.document["ended"]["how"] == "told apart"


def test_the_size_of_what_remains_is_that_of_the_simulated_unit(told_apart):
    (effect,) = told_apart.document["effects"]
    value = effect["coefficients"]["value"]
    assert abs(value["value"] - 6e-4) < 4.0 * value["standard_uncertainty"]


def test_errors_before_and_after_are_of_positions_held_out(told_apart):
    document = told_apart.document
    assert len(document["experiments"][0]["held_out_rms_V"]) == 2
    assert document["augmented"]["held_out_rms_V"] < 0.5 * document["declared"]["held_out_rms_V"]


def test_the_report_says_how_it_was_told_apart(told_apart):
    page = (told_apart.folder / "loop.html").read_text("utf-8")
    assert "How it was told apart" in page
    assert re.search(r"against [^<]*k_xx[^<]* and step between ranges: [^<]* remains", page)


def test_an_experiment_takes_as_many_samples_as_the_first_measurement(told_apart):
    first, further = sorted(told_apart.folder.glob("store/recordings/T1/*.mcap"))
    samples = {read_recording(path).points[0].readings["u_x_v"].samples for path in (first, further)}
    assert samples == {50}


def test_it_goes_on_from_its_recordings(told_apart):
    files = sorted(told_apart.folder.glob("store/recordings/T1/*.mcap"))
    ran = tumble(
        "close-loop", *files, "--stand", told_apart.folder / "s.toml", "--serial", "T1", "--experiments", "2",
        "--store", told_apart.folder / "again", "--json", "-",
    )  # fmt: skip
    assert ran.status == 0, ran.err
    assert json.loads(ran.out)["experiments"][0]["rivals_after"] == ["x.scale_asymmetry"]


def test_a_list_beyond_the_limits_of_an_axis_is_not_offered(tmp_path):
    (tmp_path / "s.toml").write_text(STAND.replace("[-190.0, 190.0]", "[-100.0, 100.0]", 1), "utf-8")
    (tmp_path / "t.csv").write_text("outer_deg,inner_deg,u_x_V,u_y_V,u_z_V\n0,0,0,0,-1\n", "utf-8")
    found = available(load_stand(tmp_path / "s.toml"), read_triad_table(tmp_path / "t.csv"))
    assert [offer.programme.name for offer in found.offers] == []
    assert "outer" in found.refused["24"][1]
