"""Geometry, bounds and fits of a triad."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from triad_tables import ARCSEC, NOISE_V, TRUTH, gravity, made, read

from tumble.calibrations.methods.triad.fit import fit_triad
from tumble.calibrations.methods.triad.geometry import directions
from tumble.calibrations.methods.triad.model import NAMES, Triad, functions, stated, stated_slopes
from tumble.calibrations.methods.triad.programmes import POSITIONS
from tumble.calibrations.methods.triad.scalar import fit_scalar
from tumble.calibrations.methods.triad.table import triad_table
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.trace import Trace

NOTHING = Trace(found=(), noise=NoiseModel(), deviance=0.0)
IDEAL = np.concatenate([np.zeros(3), np.eye(3).ravel(), np.zeros(2)])
ANGLES = np.linspace(-180.0, 180.0, 13)


def test_gravity_by_three_directions_is_that_by_rotation_matrices():
    outer_deg, inner_deg = (each.ravel() for each in np.meshgrid(ANGLES, ANGLES))
    ours = directions(outer_deg, inner_deg).gravity(900 * ARCSEC, -700 * ARCSEC)
    assert ours == pytest.approx(gravity(outer_deg, inner_deg, 900.0, -700.0), abs=1e-14)


def test_a_level_stand_at_the_outer_angle_of_90_is_a_dividing_head_with_the_face_up():
    a = directions(np.full(13, 90.0), ANGLES).gravity(0.0, 0.0)
    assert a[:, 0] == pytest.approx(-np.sin(np.deg2rad(ANGLES)), abs=1e-15)
    assert a[:, 2] == pytest.approx(np.zeros(13), abs=1e-15)


@pytest.mark.parametrize(
    ("programme", "mean_variance", "bias", "scale"),
    [
        ("24", 0.1090, 0.22, 0.354),
        ("18", 0.1484, 0.25, 0.408),
        ("12", 0.2180, 0.315, 0.50),
        ("24f", 0.0952, 0.204, 0.354),
    ],
)  # fmt: skip
def test_the_positions_reach_the_bounds_of_cramer_and_rao_that_were_computed_apart(
    programme, mean_variance, bias, scale
):
    shown = functions(directions(*np.array(POSITIONS[programme]).T))
    jacobian = shown @ Triad(functions=shown).slopes(IDEAL)
    slopes = stated_slopes(IDEAL)
    deviation = np.sqrt(np.diag(slopes @ np.linalg.inv(jacobian.T @ jacobian) @ slopes.T))
    deviation[6:] *= ARCSEC
    assert np.mean(deviation**2) == pytest.approx(mean_variance, abs=6e-5)
    assert deviation[0] == pytest.approx(bias, abs=0.01)
    assert deviation[3] == pytest.approx(scale, abs=6e-4)


def test_slopes_of_the_coefficients_are_their_derivative():
    rng = np.random.default_rng(2)
    theta, model = IDEAL + rng.normal(0.0, 0.05, 14), Triad(functions=np.zeros((0, 30)))
    step = 1e-6 * np.eye(14)
    numeric = [(model.coefficients(theta + each) - model.coefficients(theta - each)) / 2e-6 for each in step]
    assert model.slopes(theta) == pytest.approx(np.column_stack(numeric), abs=1e-8)


def test_slopes_of_what_is_stated_are_its_derivative():
    theta = IDEAL + np.random.default_rng(3).normal(0.0, 0.05, 14)
    numeric = [(stated(theta + each) - stated(theta - each)) / 2e-6 for each in 1e-6 * np.eye(14)]
    assert stated_slopes(theta) == pytest.approx(np.column_stack(numeric), rel=1e-5, abs=1e-3)


def test_without_noise_all_fourteen_parameters_come_back(tmp_path):
    fit = fit_triad(triad_table(read(tmp_path, made(noise_v=0.0))), NOTHING)
    assert dict(zip(NAMES, fit.values, strict=True)) == pytest.approx(TRUTH, rel=1e-9, abs=1e-9)


def test_without_noise_the_correction_gives_gravity_back(tmp_path):
    columns = made(noise_v=0.0)
    fit = fit_triad(triad_table(read(tmp_path, columns)), NOTHING)
    u = np.column_stack([columns[f"u_{c}_V"] for c in "xyz"])
    a = gravity(columns["outer_deg"], columns["inner_deg"], TRUTH["level_x"], TRUTH["level_y"])
    assert (u - fit.theta[:3]) @ fit.correction.T == pytest.approx(a, abs=1e-12)


def test_a_channel_that_scatters_more_counts_less(tmp_path):
    table = triad_table(read(tmp_path, made()))
    weights = table.weights[:3]
    assert weights / weights[1] == pytest.approx((NOISE_V[1] / NOISE_V) ** 2)


def test_a_circle_about_the_vertical_arm_says_nothing_of_the_channel_along_it(tmp_path):
    columns = {name: values[:8] for name, values in made("24").items()}
    kept = fit_triad(triad_table(read(tmp_path, columns)), NOTHING).parameters()
    assert kept["scale_z"].value is None
    assert "do not tell" in kept["scale_z"].reason


def test_the_scalar_fit_tells_what_is_free_of_a_rotation(tmp_path):
    columns = made(noise_v=0.0)
    fit = fit_scalar(np.column_stack([columns[f"u_{c}_V"] for c in "xyz"]), np.ones(3))
    assert fit.parameters["bias_x"].value == pytest.approx(TRUTH["bias_x"], abs=1e-10)
    longer = np.hypot(1.0, np.hypot(TRUTH["m_xy"], TRUTH["m_xz"]) * ARCSEC)
    assert fit.parameters["norm_x"].value == pytest.approx(TRUTH["scale_x"] * longer, abs=1e-10)
    assert fit.parameters["orthogonality_xy"].value == pytest.approx(TRUTH["m_xy"] + TRUTH["m_yx"], abs=0.5)
    assert fit.mismatch.largest_arcsec < 1e-6


def test_the_scalar_fit_does_not_see_a_rotation_of_the_unit():
    outer_deg, inner_deg = np.array(POSITIONS["24"]).T
    seated = gravity(outer_deg, inner_deg)
    turned = seated @ Rotation.from_rotvec([100 * ARCSEC, -60 * ARCSEC, 40 * ARCSEC]).as_matrix()
    response = np.array([[1.02, 1e-3, 0.0], [0.0, 0.98, -2e-3], [5e-4, 0.0, 1.01]])
    before, after = (fit_scalar(a @ response.T, np.ones(3)) for a in (seated, turned))
    assert np.abs(turned - seated).max() > 1e-4
    assert after.mismatch.largest_arcsec < 1e-6
    for name in ("norm_x", "norm_y", "norm_z", "orthogonality_xy"):
        assert after.parameters[name].value == pytest.approx(before.parameters[name].value, rel=1e-9)


def test_nine_dwells_leave_the_scalar_fit_without_a_scatter():
    columns = made("12o")
    u = np.column_stack([columns[f"u_{c}_V"] for c in "xyz"])[:9]
    fit = fit_scalar(u, np.ones(3))
    assert all("nothing to judge the scatter by" in parameter.reason for parameter in fit.parameters.values())
