import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import gravity_on

from tumble.calibrations.methods.dividing_head.geometry import MOUNTS, projections

angles = st.floats(-1000, 1000)
mounts = st.sampled_from(sorted(MOUNTS))


@pytest.mark.parametrize("mount", sorted(MOUNTS))
def test_projections_are_those_of_the_table_of_mounts(mount):
    angle_deg = np.array([0.0, 17.0, 90.0, 143.0, 271.0, 395.0])

    assert projections([mount] * 6, angle_deg) == pytest.approx(
        np.column_stack(gravity_on(mount, angle_deg)), abs=1e-15
    )


@given(mounts, angles)
def test_gravity_is_one_g_whatever_the_pose(mount, angle_deg):
    assert np.linalg.norm(projections([mount], np.array([angle_deg]))) == pytest.approx(1.0)


@given(mounts, angles)
def test_half_a_turn_reverses_gravity(mount, angle_deg):
    here, there = projections([mount, mount], np.array([angle_deg, angle_deg + 180.0]))

    assert there == pytest.approx(-here, abs=1e-12)


@pytest.mark.parametrize("mount", sorted(MOUNTS))
def test_a_mount_turns_the_unit_without_mirroring_it(mount):
    rotation = MOUNTS[mount]

    assert rotation @ rotation.T == pytest.approx(np.eye(3))
    assert np.linalg.det(rotation) == pytest.approx(1.0)


def test_an_x_flip_puts_ox_down_at_minus_90_and_up_at_90():
    assert projections(["face-up", "face-up"], np.array([-90.0, 90.0]))[:, 0] == pytest.approx([1.0, -1.0])


def test_an_unknown_mount_is_refused():
    with pytest.raises(KeyError, match="upside-down"):
        projections(["upside-down"], np.array([0.0]))
