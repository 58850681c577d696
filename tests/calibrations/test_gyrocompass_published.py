"""What Meleshko, Kornejchuk, Skudneva 2008 print, computed again: the formula mended, and what their conditions cost.

Expected figures: an independent simulation of 20,000 runs at φ = 50.45°, 20 s a position, tilts to 5°, any heading.
"""

import numpy as np
import pytest

from tumble.calibrations.methods.gyrocompass.azimuth_channel import heading_uncertainty_deg
from tumble.calibrations.methods.gyrocompass.cramer import coefficients, three_positions
from tumble.calibrations.methods.gyrocompass.error_table import Conditions, cost, error_table
from tumble.calibrations.methods.gyrocompass.expected import DriftNoise, expected_heading
from tumble.calibrations.methods.gyrocompass.orders import ways_to

NORTH = 9.577
WANDERING = DriftNoise(gauss_markov_deg_h=0.2, correlation_s=1000.0)


@pytest.mark.parametrize("alpha0_deg", [-170.0, -95.0, -20.0, 40.0, 130.0, 180.0])
@pytest.mark.parametrize("delta_deg", [(0.0, 90.0, 180.0), (0.0, 120.0, 240.0), (10.0, 55.0, 200.0)])
def test_the_mended_formula_gives_heading_and_drift_back(alpha0_deg, delta_deg):
    gamma_deg, beta_deg = np.array([1.0, -4.0, 3.0]), np.array([0.5, 2.0, -5.0])
    a, b = coefficients(np.array(delta_deg), NORTH, gamma_deg, beta_deg)
    rate = a * np.sin(np.deg2rad(alpha0_deg)) + b * np.cos(np.deg2rad(alpha0_deg)) + 25.0

    found = three_positions(rate, np.array(delta_deg), NORTH, gamma_deg, beta_deg)

    assert np.cos(np.deg2rad(found.alpha0_deg - alpha0_deg)) == pytest.approx(1.0, abs=1e-12)
    assert found.drift_deg_h == pytest.approx(25.0, abs=1e-9)
    assert found.closure == pytest.approx(1.0, abs=1e-9)


def test_positions_that_coincide_are_refused():
    with pytest.raises(ValueError, match="three positions that differ"):
        three_positions(np.zeros(3), np.array([0.0, 90.0, 90.0]), NORTH)


@pytest.fixture(scope="module")
def costs():
    return {str(each.cause): each for each in error_table()}


@pytest.mark.parametrize(
    ("cause", "heading_arcmin", "drift_rms", "drift_mean"),
    [
        ("random drift, Gauss-Markov", 9.2, 0.20, 0.0),
        ("azimuth, systematic", 4.7, 0.006, 0.0),
        ("azimuth, random", 2.1, 0.003, 0.0),
        ("tilt, random", 1.2, 0.002, 0.0),
        ("tilt, systematic", 0.5, 0.034, 0.034),
        ("latitude", 0.01, 0.0, 0.0),
        ("all", 10.6, 0.20, 0.034),
    ],
)
def test_each_condition_costs_what_an_independent_simulation_says(costs, cause, heading_arcmin, drift_rms, drift_mean):
    found = costs[cause]

    assert found.heading_rms_arcmin == pytest.approx(heading_arcmin, rel=0.015, abs=0.05)
    assert found.drift_rms_deg_h == pytest.approx(drift_rms, rel=0.03, abs=6e-4)
    assert found.drift_mean_deg_h == pytest.approx(drift_mean, abs=0.005)


def test_a_tenth_of_a_degree_does_not_follow_from_the_conditions(costs):
    assert costs["all"].within_tenth == pytest.approx(0.42, abs=0.015)
    assert costs["all"].heading_95_deg == pytest.approx(0.35, abs=0.01)


@pytest.mark.parametrize(("dwell_s", "heading_arcmin"), [(1.0, 7.4), (10.0, 9.2), (60.0, 15.7)])
def test_turning_fast_is_better_than_averaging_long(dwell_s, heading_arcmin):
    found = cost("", Conditions(gauss_markov_deg_h=0.2, dwell_s=dwell_s))

    assert found.heading_rms_arcmin == pytest.approx(heading_arcmin, rel=0.015)


@pytest.mark.parametrize(
    ("azimuths_deg", "free", "known"),
    [
        ((0.0, 90.0, 180.0), 0.154, 0.153),
        ((0.0, 90.0, 180.0, 270.0), 0.133, 0.129),
        ((0.0, 180.0, 90.0, 270.0), 0.097, 0.095),
        ((0.0, 90.0, 180.0) * 20, 0.027, 0.025),
    ],
)
def test_orders_in_true_averages(azimuths_deg, free, known):
    starts_s = 20.0 * np.arange(len(azimuths_deg))

    found = [
        expected_heading(azimuths_deg, starts_s, 10.0, 50.45, WANDERING, known_latitude=each).rms_deg
        for each in (False, True)
    ]

    assert found == pytest.approx([free, known], abs=6e-4)


class AtAPoint(DriftNoise):
    """The drift in the middle of each dwell, and 0.01 °/h of white noise a dwell."""

    def covariance(self, starts_s, ends_s):
        middle_s = (starts_s + ends_s) / 2.0
        return 0.04 * np.exp(-np.abs(middle_s[:, None] - middle_s) / 1000.0) + 1e-4 * np.eye(len(middle_s))


@pytest.mark.parametrize(
    ("azimuths_deg", "free"),
    [
        ((0.0, 90.0, 180.0), 0.179),
        ((0.0, 90.0, 180.0, 270.0), 0.154),
        ((0.0, 180.0, 90.0, 270.0), 0.117),
        ((0.0, 90.0, 180.0) * 20, 0.034),
    ],
)
def test_orders_with_the_drift_taken_at_a_point(azimuths_deg, free):
    starts_s = 20.0 * np.arange(len(azimuths_deg))

    found = expected_heading(azimuths_deg, starts_s, 10.0, 50.45, AtAPoint(), known_latitude=False)

    assert found.rms_deg == pytest.approx(free, abs=6e-4)


@pytest.mark.parametrize(
    ("delta_deg", "alpha0_deg", "variance"),
    [((0, 120, 240), 10.0, 2 / 3), ((0, 120, 240), 77.0, 2 / 3), ((0, 90, 180), 0.0, 0.5), ((0, 90, 180), 90.0, 1.5)],
)
def test_120_degrees_are_as_good_at_any_heading_and_90_are_not(delta_deg, alpha0_deg, variance):
    noise = DriftNoise(angle_random_walk_deg_sqrt_h=0.01)
    starts: np.ndarray = 20.0 * np.arange(3)
    sigma = np.sqrt(noise.covariance(starts, starts + 10.0)[0, 0])
    rng = np.random.default_rng(5)
    a, b = coefficients(np.array(delta_deg), NORTH, 0.0, 0.0)
    alpha0 = np.deg2rad(alpha0_deg)
    rate = a * np.sin(alpha0) + b * np.cos(alpha0) + 1e-2 * sigma * rng.normal(size=(20_000, 3))

    found = three_positions(rate, np.broadcast_to(np.array(delta_deg, dtype=float), rate.shape), NORTH)

    off = np.deg2rad(found.alpha0_deg - alpha0_deg) * NORTH / (1e-2 * sigma)
    assert np.var(off) == pytest.approx(variance, rel=0.04)


@pytest.mark.parametrize(
    ("azimuths_deg", "worst_deg"), [((0.0, 90.0, 180.0), 0.033), ((0.0, 90.0, 180.0, 90.0, 0.0), 0.0)]
)
def test_a_ramp_costs_heading_in_three_positions_and_none_there_and_back(azimuths_deg, worst_deg):
    delta, ramp_deg_h = np.deg2rad(azimuths_deg), 20.0 * np.arange(len(azimuths_deg)) / 3600.0  # 1 °/h²
    errors_deg = []
    for alpha in np.deg2rad(np.arange(0.0, 360.0, 5.0)):
        along, across = NORTH * np.cos(delta + alpha), NORTH * np.sin(delta + alpha)
        design = np.column_stack([along, across, np.ones(len(delta))])
        errors_deg.append(np.rad2deg(np.linalg.lstsq(design, ramp_deg_h, rcond=None)[0][0]))

    assert np.abs(errors_deg).max() == pytest.approx(worst_deg, abs=5e-4)


def test_a_wandering_drift_alone_turns_the_heading_by_0_29_degrees_in_4_hours():
    assert heading_uncertainty_deg(4.0, 0.0, 0.0, WANDERING) == pytest.approx(0.29, abs=0.003)


def test_the_quickest_ways_reach_what_is_wanted():
    found = ways_to(0.1, 10.0, 50.45, WANDERING, ("0/90/180", "0/180/90/270"))

    assert [each.order for each in found] == ["0/180/90/270", "0/90/180"]
    assert all(each.heading.rms_deg <= 0.1 for each in found)
