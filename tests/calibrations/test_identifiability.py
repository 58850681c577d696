import numpy as np
import pytest
from tables import FLIPS, UNIT, sweep, table

from tumble.calibrations.methods.dividing_head.analysis import analyse


def parameters(*parts, **options):
    return analyse(table(*parts, **options), trials=0).parameters


def test_a_face_up_sweep_rests_alpha0_kx_and_ky_on_kxy():
    found = parameters(sweep("face-up"))

    assert {name for name, p in found.items() if p.rests_on == "kxy"} == {"kx", "ky", "alpha0"}
    assert found["alpha0"].settled_by == ("face-down", "edge", "edge-back", "end")


def test_the_seed_programme_rests_kz_on_kxy_too():
    found = parameters(*FLIPS, sweep("face-up"))

    assert {name for name, p in found.items() if p.rests_on == "kxy"} == {"kx", "ky", "kz", "alpha0"}
    assert found["alpha0"].settled_by == ("face-down", "edge-back", "end")


@pytest.mark.parametrize("mount", ["face-down", "edge-back", "end"])
def test_a_sweep_in_a_mount_that_settles_it_ends_the_dependence(mount):
    found = parameters(*FLIPS, sweep("face-up"), sweep(mount))

    assert [p.rests_on for p in found.values()] == [""] * 6


def test_a_quarter_turn_about_the_head_axis_does_not_end_the_dependence():
    found = parameters(*FLIPS, sweep("face-up"), sweep("face-up-90"))

    assert found["ky"].rests_on == "kxy"


def test_without_curvature_alpha0_is_null_and_what_hangs_on_it_is_conditional():
    found = parameters(*FLIPS, sweep("face-up"), unit=dict(UNIT, kxy=0.0))

    assert found["alpha0"].value is None
    assert "45 deg" in found["alpha0"].reason
    assert {name for name, p in found.items() if p.given == {"alpha0": 0.0}} == {"kx", "ky", "kz"}
    assert found["ky"].value == pytest.approx(UNIT["ky"] + UNIT["kx"] * np.deg2rad(UNIT["alpha0"]), abs=1e-4)


def test_without_an_edge_mount_kz_is_null():
    found = parameters(sweep("face-up"), sweep("face-down"))

    assert found["kz"].value is None
    assert "Oz" in found["kz"].reason
    assert found["ky"].value is not None


def test_flips_alone_cannot_tell_kxy():
    found = parameters(*FLIPS)

    assert found["kxy"].value is None
    assert found["kxy"].standard_uncertainty is None
    assert found["u0"].given == {}


def test_a_single_pose_tells_nothing():
    found = parameters(("flip", "face-up", [-90.0]))

    assert [p.value for p in found.values()] == [None] * 6


def test_no_spare_rows_leave_every_parameter_without_an_uncertainty_and_so_null():
    found = parameters(("flip", "face-up", [-90.0, 90.0]), realisations=1)

    assert [p.value for p in found.values()] == [None] * 6
    assert "no more rows than parameters" in found["u0"].reason


def test_the_end_mount_alone_cannot_tell_kx():
    assert parameters(sweep("end"))["kx"].value is None
