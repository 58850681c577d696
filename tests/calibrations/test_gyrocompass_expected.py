"""How uncertain a heading will be: figures of the digest, and covariances by simulation."""

import numpy as np
import pytest
from scipy.integrate import quad

from tumble.calibrations.methods.gyrocompass.expected import DriftNoise, expected_heading

NORTH_DEG_H = 15.041068 * np.cos(np.deg2rad(50.45))


def heading(azimuths_deg, noise, known_latitude=True):
    """10 s of averaging, 10 s of turning."""
    starts_s = [20.0 * number for number in range(len(azimuths_deg))]
    return expected_heading(azimuths_deg, starts_s, 10.0, 50.45, noise, known_latitude=known_latitude)


@pytest.mark.parametrize(
    ("azimuths_deg", "free", "known"),
    [
        ((0, 90, 180), 0.154, 0.153),
        ((0, 90, 180, 270), 0.133, 0.129),
        ((0, 180, 90, 270), 0.097, 0.095),
        ((0, 90, 180) * 20, 0.027, 0.025),
    ],
)
def test_the_orders_of_the_digest_come_back(azimuths_deg, free, known):
    """Gauss-Markov 0.2 °/h with 1/1000 s, true 10 s averages, r.m.s. over all headings."""
    noise = DriftNoise(gauss_markov_deg_h=0.2, correlation_s=1000.0)
    assert heading(azimuths_deg, noise, known_latitude=False).rms_deg == pytest.approx(free, abs=6e-4)
    assert heading(azimuths_deg, noise).rms_deg == pytest.approx(known, abs=6e-4)


@pytest.mark.parametrize(("azimuths_deg", "mean", "worst"), [((0, 120, 240), 2 / 3, 2 / 3), ((0, 90, 180), 1.0, 1.5)])
def test_in_white_noise_120_deg_are_as_good_at_every_heading(azimuths_deg, mean, worst):
    """In (σ/ωη)²: the digest has ⅔ at any heading, and ½ to 1½ for a quarter turn."""
    found = heading(azimuths_deg, DriftNoise(angle_random_walk_deg_sqrt_h=1e-3), known_latitude=False)
    unit_deg = np.rad2deg(1e-3 / np.sqrt(10.0 / 3600.0) / NORTH_DEG_H)
    assert (found.rms_deg / unit_deg) ** 2 == pytest.approx(mean, rel=1e-3)
    assert (found.worst_deg / unit_deg) ** 2 == pytest.approx(worst, rel=1e-3)


def test_positions_that_do_not_tell_a_heading_have_none():
    assert heading((0, 0, 360), DriftNoise(angle_random_walk_deg_sqrt_h=1e-3)) is None


STARTS_S, ENDS_S = np.array([0.0, 20.0, 50.0]), np.array([10.0, 45.0, 60.0])


def test_a_gauss_markov_process_has_the_covariance_of_its_integral():
    noise = DriftNoise(gauss_markov_deg_h=0.3, correlation_s=30.0)
    found = noise.covariance(STARTS_S, ENDS_S)
    for i, j in ((0, 0), (0, 1), (1, 2), (2, 2)):
        mean = quad(
            lambda s, j=j: _mean_of(lambda t, s=s: np.exp(-abs(t - s) / 30.0), STARTS_S[j], ENDS_S[j], s),
            STARTS_S[i],
            ENDS_S[i],
        )[0] / (ENDS_S[i] - STARTS_S[i])
        assert found[i, j] == found[j, i] == pytest.approx(0.09 * mean, rel=1e-6)


def _mean_of(function, start, end, kink):
    inside = [kink] if start < kink < end else None
    return quad(function, start, end, points=inside)[0] / (end - start)


def test_a_random_walk_has_the_variance_of_its_differences():
    """K² T / 3 for two means over T that follow on each other: twice its Allan variance (IEEE 952)."""
    both = DriftNoise(rate_random_walk_deg_h_sqrt_h=0.5).covariance(np.array([0.0, 360.0]), np.array([360.0, 720.0]))
    assert both[0, 0] + both[1, 1] - 2.0 * both[0, 1] == pytest.approx(2.0 * 0.25 * 0.1 / 3.0)


def test_flicker_has_its_allan_deviation_at_every_averaging_time():
    """0.664 B, √(2 ln 2 / π) B (IEEE 952)."""
    for time_s in (1.0, 100.0, 10_000.0):
        starts_s = np.array([0.0, time_s])
        both = DriftNoise(bias_instability_deg_h=0.1).covariance(starts_s, starts_s + time_s)
        allan = (both[0, 0] + both[1, 1] - 2.0 * both[0, 1]) / 2.0
        assert np.sqrt(allan) == pytest.approx(0.1 * np.sqrt(2.0 * np.log(2.0) / np.pi), rel=1e-9)


def test_a_fit_with_these_weights_scatters_as_was_promised():
    """20,000 runs of four positions in drift of all kinds."""
    noise = DriftNoise(
        angle_random_walk_deg_sqrt_h=5e-4,
        bias_instability_deg_h=0.02,
        rate_random_walk_deg_h_sqrt_h=0.1,
        gauss_markov_deg_h=0.1,
        correlation_s=100.0,
    )
    starts_s = np.array([0.0, 20.0, 40.0, 60.0])
    root = np.linalg.cholesky(noise.covariance(starts_s, starts_s + 10.0))
    alpha = np.deg2rad(np.array([0.0, 180.0, 90.0, 270.0]) + 30.0)
    design = np.column_stack([NORTH_DEG_H * np.cos(alpha), np.ones(4)])
    drawn = root @ np.random.default_rng(5).standard_normal((4, 20_000))
    white = np.linalg.solve(root, np.column_stack([design, drawn]))
    estimates = np.linalg.lstsq(white[:, :2], white[:, 2:])[0][0]
    promised = expected_heading([0, 180, 90, 270], starts_s.tolist(), 10.0, 50.45, noise)
    assert np.rad2deg(estimates.std()) == pytest.approx(promised.rms_deg, rel=0.1)
