import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares
from tables import FLIPS, UNIT, sweep, table

from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.methods.dividing_head.conditional import conditional
from tumble.calibrations.methods.dividing_head.fit import alpha0_profile, covariance, fit_given_alpha0, joint_fit
from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.calibrations.methods.dividing_head.model import ALPHA0, PARAMETERS, basis, coefficients


def compressed(rows):
    return compress(basis(rows), rows.voltage_v, np.ones(len(rows)))


@settings(max_examples=30, deadline=None)
@given(st.floats(-40, 40), st.sampled_from([-0.003, -0.0004, 0.0004, 0.003]))
def test_an_exact_table_gives_its_parameters_back(alpha0, kxy):
    unit = dict(UNIT, alpha0=alpha0, kxy=kxy)
    rows = table(*FLIPS, sweep("face-up"), sweep("face-down"), realisations=1, noise_v=0.0, unit=unit)

    assert joint_fit(compressed(rows)).theta == pytest.approx([unit[name] for name in PARAMETERS], abs=1e-9)


def test_a_negative_kxy_keeps_its_sign_and_alpha0_its_branch():
    unit = dict(UNIT, kxy=-0.01, alpha0=-2.0)
    fit = joint_fit(compressed(table(sweep("face-up"), realisations=1, noise_v=0.0, unit=unit)))

    assert fit.theta[PARAMETERS.index("kxy")] == pytest.approx(-0.01)
    assert fit.theta[ALPHA0] == pytest.approx(-2.0)


def test_the_minimum_is_that_of_an_independent_solver():
    rows = table(*FLIPS, sweep("face-up"), sweep("edge"), seed=3, noise_v=5e-4)
    functions = basis(rows)
    start = [2.5, 1.0, 0.0, 0.0, 0.001, 0.0]
    scale = [1, 1, 1e-2, 1e-2, 1e-3, 1]
    scipy = least_squares(
        lambda t: 1e4 * (rows.voltage_v - functions @ coefficients(t)), start, "3-point", x_scale=scale, xtol=1e-15
    )
    fit = joint_fit(compressed(rows))

    assert fit.squares_v2 == pytest.approx(2e-8 * scipy.cost, rel=1e-9)
    assert fit.theta == pytest.approx(scipy.x, rel=1e-4, abs=1e-5)


def test_fewer_rows_than_basis_functions_still_fit():
    rows = table(*FLIPS, realisations=1, noise_v=0.0)

    assert fit_given_alpha0(compressed(rows), UNIT["alpha0"]).theta[:4] == pytest.approx(
        [2.5, 1.0, 0.0098, 0.002], abs=1e-5
    )


def test_a_sharp_alpha0_gives_the_linearised_covariance():
    rows = table(*FLIPS, sweep("face-up"), sweep("face-down"), sweep("edge"))
    c = compressed(rows)
    fit = joint_fit(c)
    profile = alpha0_profile(c, fit, 1e-8, 1.96)

    assert np.diag(covariance(c, fit, profile, 1e-8)) == pytest.approx(
        np.diag(1e-8 * fit.inverse @ fit.inverse.T), rel=1e-3
    )


def test_a_blunt_alpha0_passes_its_curvature_on_to_kx():
    unit = dict(UNIT, ky=0.0, alpha0=0.0)
    rows = table(sweep("face-up"), noise_v=1e-5, unit=unit)
    c = compressed(rows)
    fit = joint_fit(c)
    variance = (1e-4) ** 2
    u_alpha0 = np.sqrt(variance * (fit.inverse @ fit.inverse.T)[ALPHA0, ALPHA0])
    from_curvature = np.sqrt(3) / 2 * np.deg2rad(u_alpha0) ** 2
    kx = PARAMETERS.index("kx")
    total = np.sqrt(covariance(c, fit, alpha0_profile(c, fit, variance, 1.96), variance)[kx, kx])

    assert total == pytest.approx(np.hypot(from_curvature, 1e-4 * np.sqrt(2 / 400)), rel=0.1)


def test_the_profile_interval_ends_where_the_misfit_has_grown_by_k_squared():
    rows = table(sweep("face-up"))
    c = compressed(rows)
    fit = joint_fit(c)
    profile = alpha0_profile(c, fit, 1e-8, 2.0)

    grown = conditional(c, np.array(profile.interval_deg)).squares_v2 - fit.squares_v2
    assert grown == pytest.approx([4e-8, 4e-8], rel=1e-3)


def test_alpha0_is_not_identifiable_without_curvature():
    c = compressed(table(*FLIPS, sweep("face-up"), unit=dict(UNIT, kxy=0.0)))
    fit = joint_fit(c)

    assert not alpha0_profile(c, fit, 1e-8, 1.96).identifiable


@pytest.mark.parametrize(("freedom", "k"), [(1, 12.71), (2, 4.30), (5, 2.57), (10, 2.23), (20, 2.09), (50, 2.01)])
def test_coverage_factor_is_that_of_gum_table_g_2(freedom, k):
    assert coverage_factor(freedom) == pytest.approx(k, abs=0.005)


@settings(max_examples=20, deadline=None)
@given(st.sampled_from([-2e-3, -3e-4, 3e-4, 2e-3]), st.integers(0, 10**6))
def test_no_alpha0_leaves_less_where_an_effect_is_missing_or_added(kxx, seed):
    rows = table(*FLIPS, sweep("face-up"), realisations=1, noise_v=1e-4, seed=seed)
    functions = basis(rows)
    squared = projections(rows.mounts, rows.angle_deg)[:, :1] ** 2
    voltage_v = rows.voltage_v + kxx * squared[:, 0]
    for columns in (functions, np.column_stack([functions, squared])):
        c = compress(columns, voltage_v, np.ones(len(rows)))
        least = conditional(c, np.linspace(-45.0, 45.0, 9001)).squares_v2.min()
        assert joint_fit(c).squares_v2 <= least * (1 + 1e-9)


def test_a_column_of_rounding_is_given_no_coefficient():
    rows = table(*FLIPS, sweep("face-up"), realisations=1)
    columns = np.column_stack([basis(rows), np.full(len(rows), 1e-17)])

    assert joint_fit(compress(columns, rows.voltage_v, np.ones(len(rows)))).theta[-1] == 0.0
