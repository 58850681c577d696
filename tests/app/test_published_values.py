"""The published result of a DXL203EB is what the built-in stand simulates; both experiments must give it back."""

import pytest
from app_jobs import tumble

from tumble.app.analysing import fit
from tumble.app.measurements import read_measurement

PUBLISHED = {"u0": 2.5, "kx": 1.0, "ky": 0.0098, "kz": 0.002, "kxy": 0.001, "alpha0": 0.1121}
MOUNTS = ("face-up", "face-down", "edge", "edge-back", "face-up-90", "end")
REVERSAL = 'name = "short-reversal"\ndwell_s = 0.5\n[[procedure]]\nkind = "flip"\naxes = ["x", "y", "z"]\n' + "".join(
    f'[[procedure]]\nkind = "sweep"\nmount = "{mount}"\nstep_deg = 15.0\npoints = 24\n' for mount in MOUNTS
)


def found_by(programme, folder):
    recording = folder / "x.mcap"
    assert tumble("run", "--programme", programme, "--serial", "A", "--out", recording).status == 0
    return fit(read_measurement(recording), trials=0).calibration.parameters


@pytest.fixture(scope="module")
def by_seed(tmp_path_factory):
    return found_by("seed", tmp_path_factory.mktemp("seed"))


@pytest.fixture(scope="module")
def by_reversal(tmp_path_factory):
    folder = tmp_path_factory.mktemp("reversal")
    (folder / "reversal.toml").write_text(REVERSAL)
    return found_by(folder / "reversal.toml", folder)


@pytest.mark.parametrize("name", PUBLISHED)
def test_the_published_programme_gives_it_back(by_seed, name):
    assert abs(by_seed[name].value - PUBLISHED[name]) < 3 * by_seed[name].standard_uncertainty


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_run_in_every_mount_gives_it_back(by_reversal, name):
    assert abs(by_reversal[name].value - PUBLISHED[name]) < 3 * by_reversal[name].standard_uncertainty


def test_the_published_programme_leans_on_kxy_and_the_reversal_does_not(by_seed, by_reversal):
    assert by_seed["alpha0"].rests_on == "kxy"
    assert by_reversal["alpha0"].rests_on == ""
    assert by_reversal["alpha0"].standard_uncertainty < by_seed["alpha0"].standard_uncertainty / 50
