"""Gravity on the axes of a simulated unit, against values worked out by hand from the table of mounts."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.simulated.geometry import SEATS, ax_turning_points_deg, projections, rotation, seat

MOUNT_NAMES = st.sampled_from(sorted(SEATS))
ANGLES_DEG = st.floats(-800.0, 800.0)

S, C = 0.5, 0.8660254037844386  # sine and cosine of 30 degrees


@pytest.mark.parametrize(
    ("mount", "expected_g"),
    [
        ("face-up", (-S, -C, 0.0)),
        ("face-up-90", (-C, S, 0.0)),
        ("face-down", (-S, C, 0.0)),
        ("edge", (-S, 0.0, -C)),
        ("edge-back", (-S, 0.0, C)),
        ("end", (0.0, -S, -C)),
    ],
)
def test_each_mount_at_30_degrees(mount, expected_g):
    assert projections(seat(mount), np.array([30.0]), 0.0)[0] == pytest.approx(expected_g, abs=1e-12)


@pytest.mark.parametrize(
    ("mount", "angle_deg", "axis"),
    [
        ("face-up", -90.0, 0),
        ("face-up", 180.0, 1),
        ("edge", 180.0, 2),
    ],
)
def test_the_axis_of_a_flip_points_down(mount, angle_deg, axis):
    gravity_g = projections(seat(mount), np.array([angle_deg]), 0.0)[0]
    assert gravity_g == pytest.approx(np.eye(3)[axis], abs=1e-12)


@pytest.mark.parametrize(
    ("mount", "axis", "sign"), [("face-up", 2, 1), ("face-down", 2, -1), ("edge-back", 1, 1), ("end", 0, 1)]
)
def test_a_tilted_axis_puts_gravity_on_what_lies_along_it(mount, axis, sign):
    gravity_g = projections(seat(mount), np.array([20.0]), 30.0)[0]
    assert gravity_g[axis] == pytest.approx(sign * 0.5)


def test_a_mount_that_does_not_exist_is_named_with_those_that_do():
    with pytest.raises(ValueError, match="there is no mount 'upside'; known are face-up, "):
        seat("upside")


@given(MOUNT_NAMES, ANGLES_DEG, st.floats(-90.0, 90.0))
def test_gravity_keeps_its_length(mount, angle_deg, tilt_deg):
    assert np.linalg.norm(projections(seat(mount), np.array([angle_deg]), tilt_deg)) == pytest.approx(1.0)


@given(MOUNT_NAMES)
def test_every_seat_is_a_rotation(mount):
    seated = seat(mount)
    assert seated @ seated.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(seated) == pytest.approx(1.0)


@given(st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda axis: np.linalg.norm(axis) > 0.1), ANGLES_DEG)
def test_a_rotation_leaves_its_axis_alone(axis, angle_deg):
    assert rotation(axis, angle_deg) @ np.array(axis) == pytest.approx(np.array(axis), abs=1e-9)


@pytest.mark.parametrize(
    ("mount", "from_deg", "to_deg", "expected_deg"),
    [
        ("face-up", 0.0, 360.0, [90.0, 270.0]),
        ("face-up", 360.0, 0.0, [270.0, 90.0]),
        ("face-up-90", 10.0, 190.0, [180.0]),
        ("face-up", -80.0, 80.0, []),
    ],
)
def test_ax_turns_back_where_ox_is_vertical(mount, from_deg, to_deg, expected_deg):
    assert ax_turning_points_deg(seat(mount), from_deg, to_deg).tolist() == pytest.approx(expected_deg)
