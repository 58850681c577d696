"""Earth rate in pickoff angles of a turntable that leans, against rotation matrices; the model on the circle."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tumble.calibrations.methods.gyrocompass.geometry import (
    EARTH_RATE_DEG_H,
    heading_functions,
    heading_slopes,
    platform_azimuth_rad,
    wrapped_deg,
)
from tumble.calibrations.methods.gyrocompass.lean import Lean, leans
from tumble.calibrations.methods.gyrocompass.model import best_angle, direction
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations, read_gyrocompass_table

DELTA_DEG = np.arange(0.0, 360.0, 20.0)
LATITUDE_DEG = np.full(len(DELTA_DEG), 50.45)
ALPHA0_DEG, GAMMA_DEG, KAPPA_DEG = 71.0, 4.0, -3.0


def input_axis():
    """East, north and up parts of the levelled axis: Rz(α0) Ry(γ0) Rx(κ) Rz(δ) applied to x."""
    base = Rotation.from_euler("ZYX", [ALPHA0_DEG, GAMMA_DEG, KAPPA_DEG], degrees=True)
    turned = Rotation.from_euler("z", DELTA_DEG[:, None], degrees=True)
    return (base * turned).apply([1.0, 0.0, 0.0])


def lean_of(axis):
    tilt = -axis[:, 2]
    return Lean(
        cosine=np.full(len(tilt), tilt[0]),
        sine=np.full(len(tilt), -np.sin(np.deg2rad(KAPPA_DEG)) * np.cos(np.deg2rad(GAMMA_DEG))),
    )


def test_the_earth_rate_is_the_scalar_product_with_the_axis():
    axis = input_axis()

    found = heading_functions(np.deg2rad(DELTA_DEG), LATITUDE_DEG, lean_of(axis)) @ direction(np.deg2rad(ALPHA0_DEG))

    np.testing.assert_allclose(found, EARTH_RATE_DEG_H * np.cos(np.deg2rad(50.45)) * axis[:, 1], atol=1e-12)


def test_the_tilt_follows_the_lean():
    axis = input_axis()

    np.testing.assert_allclose(lean_of(axis).sin_tilt(np.deg2rad(DELTA_DEG)), -axis[:, 2], atol=1e-12)


def test_slopes_are_derivatives():
    lean, delta = lean_of(input_axis()), np.deg2rad(DELTA_DEG)

    by_steps = (
        heading_functions(delta + 1e-6, LATITUDE_DEG, lean) - heading_functions(delta - 1e-6, LATITUDE_DEG, lean)
    ) / 2e-6

    np.testing.assert_allclose(heading_slopes(delta, LATITUDE_DEG, lean), by_steps, atol=1e-7)


def test_the_azimuth_is_that_of_the_axis_from_east():
    axis = input_axis()

    found = np.rad2deg(platform_azimuth_rad(np.deg2rad(ALPHA0_DEG), np.deg2rad(DELTA_DEG), lean_of(axis)))

    expected = np.rad2deg(np.arctan2(axis[:, 1], axis[:, 0]))
    assert max(abs(wrapped_deg(each)) for each in found - expected) < 1e-10


def test_at_leans_of_5_degrees_the_azimuth_is_up_to_26_minutes_from_the_pickoff():
    delta = np.deg2rad(np.arange(0.0, 360.0, 1.0))
    sine = np.sin(np.deg2rad(5.0))
    lean = Lean(cosine=np.full(len(delta), sine), sine=np.full(len(delta), sine))

    off = np.rad2deg(platform_azimuth_rad(0.0, delta, lean) - delta)

    assert 60.0 * max(abs(wrapped_deg(each)) for each in off) == pytest.approx(26.0, abs=0.6)


def test_leans_are_found_beside_a_bias_and_a_wrong_tilt():
    delta = np.deg2rad(DELTA_DEG)
    sine = 0.02 * np.cos(delta) - 0.03 * np.sin(delta) + 1e-4
    sine[4] += 0.01
    count = len(delta)
    rows = GyrocompassObservations(
        row=np.arange(1, count + 1),
        azimuth_deg=DELTA_DEG,
        latitude_deg=LATITUDE_DEG,
        rate_deg_h=np.zeros(count),
        tilt_gamma_deg=np.rad2deg(np.arcsin(sine)),
    )

    found = leans(rows)

    np.testing.assert_allclose((found.cosine[0], found.sine[0]), (0.02, -0.03), atol=1e-6)


@pytest.mark.parametrize("alpha_deg", [-179.0, -95.0, 0.0, 60.0, 180.0])
def test_the_best_angle_is_found_from_no_start(alpha_deg):
    f = np.array([[3.0, 0.4], [0.1, 1.0]])

    found = best_angle(f, f @ direction(np.deg2rad(alpha_deg)))

    assert wrapped_deg(np.rad2deg(found) - alpha_deg) == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize(("angle_deg", "expected"), [(180.0, 180.0), (-180.0, 180.0), (181.0, -179.0), (0.0, 0.0)])
def test_angles_are_above_minus_180_up_to_180(angle_deg, expected):
    assert wrapped_deg(angle_deg) == pytest.approx(expected)


def test_near_a_pole_there_is_no_heading(tmp_path):
    (tmp_path / "pole.csv").write_text(
        "azimuth_deg,latitude_deg,rate_deg_h\n" + "".join(f"{90 * k},89.5,{0.1 * k}\n" for k in range(4)), "utf-8"
    )
    rows = read_gyrocompass_table(tmp_path / "pole.csv")
    assert (len(rows), len(rows.set_aside)) == (0, 4)
