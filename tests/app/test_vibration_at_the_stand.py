"""Vibration rectification at the simulated stand, by the commands that serve every method."""

import json
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from app_jobs import tumble

from tumble.app.measurements import read_measurement
from tumble.app.stand import read_stand

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "shaker.toml"
TRUE = {"k_ii": 22.0, "k_oo": -6.0, "k_pp": 9.0, "k_io": 14.0, "k_ip": -8.0}
SHORT = 'method = "vibration"\nname = "p"\ndwell_s = 1.0\nsettle_s = 0.1\n\n[[procedure]]\n'
CENTRIFUGE = 'kind = "centrifuge"\nmountings = [{ x = "i", y = "p", down = "o" }]\n'
FIVE_MOUNTINGS = """levels_g = [6.0, 10.0]
frequencies_Hz = [81.3]
mountings = [
    { x = "i", y = "o" }, { x = "o", y = "i" }, { x = "p", y = "i", down = "o" },
    { x = "i+o", y = "i-o" }, { x = "i+p", y = "i-p", down = "o" },
]
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def done(*words):
    """What a command says that ends well."""
    ran = tumble(*words)
    assert ran.status == 0, ran.err
    return ran.out


def programme(folder, procedure):
    (folder / "p.toml").write_text(SHORT + procedure, "utf-8")
    return "p.toml"


def rows_of(folder, procedure, *options):
    done("run", "--programme", programme(folder, procedure), "--serial", "V", "--out", "r.mcap", *options)
    return read_measurement(folder / "r.mcap").observations


def test_one_command_from_the_stand_to_the_report(folder):
    named = ("--programme", programme(folder, FIVE_MOUNTINGS), "--serial", "V1")
    done("calibrate", *named, "--store", "s", "--json", "result.json")
    document = json.loads((folder / "result.json").read_text("utf-8"))
    found = document["loop"]["augmented"]["parameters"]
    for name, value in TRUE.items():
        assert abs(found[name]["value"] - value) < 4.0 * found[name]["standard_uncertainty"]
    (report,) = (folder / "s" / "reports").glob("*.html")
    assert report.read_text("utf-8").rstrip().endswith("</html>")


@pytest.mark.parametrize(
    ("name", "told", "rank"),
    [
        ("vibration-input-axis", {"k_ii"}, 1),
        ("vibration", {"k_ii", "k_oo", "k_pp", "k_io", "k_ip"}, 5),
        ("vibration-centrifuge", {"k_ii", "k_oo", "k_pp"}, 3),
        ("vibration-three-shakers", {"k_ii", "k_oo", "k_pp", "k_io", "k_ip"}, 5),
        ("vibration-phases", {"k_io", "k_ip", "k_ii+k_oo", "k_ii+k_pp"}, 4),
    ],
)
def test_a_plan_says_what_its_dwells_tell(name, told, rank, folder):
    done("plan", name, "--json", "plan.json")
    document = json.loads((folder / "plan.json").read_text("utf-8"))
    assert (set(document["uncertainty_ug_g2_per_ug"]), document["rank"]) == (told, rank)


def test_one_frequency_is_no_range(folder):
    said = done("plan", programme(folder, "levels_g = [5, 10]\nfrequencies_Hz = [81.3]"))
    assert "Peaks of 5 to 10 g at 81.3 Hz." in said


def test_a_double_centrifuge_with_one_axis_up_tells_the_sum(folder):
    said = done("plan", programme(folder, f"{CENTRIFUGE}main_rad_s = [4.4, 6.3]\nfrequencies_Hz = [1]"))
    assert "k_ii+k_pp" in said
    assert "Not told alone: k_ii, k_oo, k_pp, k_io and k_ip" in said


def test_the_frequency_that_the_drive_really_has_is_found_and_harmonics_count(folder):
    rows = rows_of(folder, "levels_g = [5.0]\nfrequencies_Hz = [81.3]")
    assert rows.fi_hz[1] == pytest.approx(81.3 * 1.003, abs=1e-3)
    assert rows.ai_g[1] == pytest.approx(5.0, abs=1e-3)
    assert rows.mii_g2[1] == pytest.approx(0.5 * 25.0 * (1.0 + 0.02**2), rel=1e-4)


def test_sideways_motion_is_seen_by_its_own_reference(folder):
    own = (files("tumble.procedures.methods.vibration") / "stand.toml").read_text("utf-8")
    (folder / "stand.toml").write_text(f"{own}effects = {{ shaker_cross = {{ ratio = 0.04 }} }}\n", "utf-8")
    rows = rows_of(folder, "levels_g = [5.0]\nfrequencies_Hz = [81.3]", "--stand", "stand.toml")
    assert rows.ao_g[1] == pytest.approx(0.2, abs=1e-3)
    assert rows.mio_g2[1] == pytest.approx(0.5 * 25.0 * 0.04, rel=2e-3)


def test_phases_of_two_shakers_are_told(folder):
    rows = rows_of(
        folder,
        'kind = "shakers"\nlevels_g = { x = 3, y = 4 }\nfrequencies_Hz = { x = 40.3, y = 40.3 }\n'
        "phases_deg = [{ y = 90 }, { y = 180 }]",
    )
    apart_deg = (rows.phase_o_deg - rows.phase_i_deg)[[1, 3]] % 360.0
    assert apart_deg == pytest.approx([90.0, 180.0], abs=0.1)
    assert rows.mio_g2[[1, 3]] == pytest.approx([0.0, -6.0], abs=0.02)
    assert set(rows.apparatus) == {"multi-shaker"}


def test_a_centrifuge_says_its_rates_and_its_two_axes(folder):
    rows = rows_of(folder, f"{CENTRIFUGE}main_rad_s = [6.0]\nfrequencies_Hz = [4, -4]")
    level_g = 0.5 * 36.0 / 9.80665
    assert (rows.ai_g[1], rows.ap_g[1], rows.ao_g[1]) == (pytest.approx(level_g), pytest.approx(level_g), 0.0)
    assert rows.sub_rad_s[[1, 3]] == pytest.approx([8.0 * np.pi, -8.0 * np.pi])
    assert abs(rows.mip_g2[1]) < 1e-9
    assert set(rows.apparatus) == {"double-centrifuge"}


def test_random_vibration_is_told_by_its_mean_products(folder):
    where = 'mountings = [{ x = "i+o", y = "i-o" }]'
    rows = rows_of(folder, f'kind = "random"\nprofile = "flat-20-500"\nlevels_g = [2.0]\n{where}')
    assert rows.vibrated.tolist() == [False, True, False]
    assert rows.mii_g2[1] == pytest.approx(2.0, rel=0.25)
    assert rows.mio_g2[1] == pytest.approx(rows.mii_g2[1], rel=1e-3)


def test_a_level_that_is_missed_is_told_and_what_was_reached_is_used(folder):
    own = (files("tumble.procedures.methods.vibration") / "stand.toml").read_text("utf-8")
    (folder / "stand.toml").write_text(f"{own}level_error = -0.4\n", "utf-8")
    rows = rows_of(folder, "levels_g = [5.0]\nfrequencies_Hz = [81.3]", "--stand", "stand.toml")
    assert rows.ai_g[1] == pytest.approx(3.0, abs=1e-3)
    assert "point 1: 5 g were commanded, and the reference says 3.001 g" in " ".join(rows.warnings)


def test_a_limit_of_the_stand_is_told_before_anything_shakes(folder):
    ran = tumble("plan", programme(folder, "levels_g = [25.0]\nfrequencies_Hz = [80]"))
    assert ran.status == 2
    assert "needs sine 25 g 80 Hz, and the exciter may not do 25 g, only 20 g" in ran.err


def test_the_example_of_a_stand_can_be_read():
    file = read_stand(EXAMPLE).file
    assert (file.most, file.positioners) == ({"reference_x_v": pytest.approx(1.5)}, {})
