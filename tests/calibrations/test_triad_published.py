"""What is printed of a triad in Dzuev 2018, computed again: mismatches of tables 4.5 and 4.9, in arc seconds."""

import numpy as np
import pytest

from tumble.calibrations.methods.triad.geometry import ARCSEC_PER_RAD, directions
from tumble.calibrations.methods.triad.programmes import POSITIONS

AT_30_DEGC = np.array([
    -2.9, -1.8, -5.5, -7.3, -1.2, -2.9, -5.7, -3.4, 3.0, 1.6, -4.7, -3.9,
    8.5, 0.0, -5.1, 1.9, 2.9, 1.6, 6.1, 0.7, 2.5, 4.1, 5.7, 4.3,
])  # fmt: skip
AT_60_DEGC = np.array([
    -9.3, -0.9, -6.0, -16.8, -6.3, -5.2, -4.5, -9.6, 2.9, -1.4, -5.8, -0.5,
    9.4, -3.4, -5.1, 4.1, 8.8, 3.3, 6.8, 6.7, 8.8, 7.8, 5.6, 8.6,
])  # fmt: skip
SPENT = 9
"""Parameters of the scalar fit."""


def without_trend(mismatch):
    place = np.arange(len(mismatch))
    return mismatch - np.polyval(np.polyfit(place, mismatch, 1), place)


def correlation(first, second):
    return float(np.corrcoef(first, second)[0, 1])


@pytest.mark.parametrize(("mismatch", "spread", "trend"), [(AT_30_DEGC, 4.29, 0.41), (AT_60_DEGC, 7.21, 0.81)])
def test_spread_and_trend_of_the_mismatch(mismatch, spread, trend):
    assert np.std(mismatch, ddof=1) == pytest.approx(spread, abs=0.01)
    assert np.polyfit(np.arange(24), mismatch, 1)[0] == pytest.approx(trend, abs=0.01)


@pytest.mark.parametrize(("mismatch", "spread"), [(AT_30_DEGC, 5.3), (AT_60_DEGC, 8.9)])
def test_the_spread_with_the_degrees_of_freedom_that_the_fit_spends(mismatch, spread):
    assert np.sqrt(np.sum(mismatch**2) / (24 - SPENT)) == pytest.approx(spread, abs=0.1)


def test_a_pattern_comes_back_between_two_runs():
    assert correlation(AT_30_DEGC, AT_60_DEGC) == pytest.approx(0.86, abs=0.005)
    assert correlation(without_trend(AT_30_DEGC), without_trend(AT_60_DEGC)) == pytest.approx(0.73, abs=0.005)


def test_no_other_order_of_the_positions_gives_such_a_pattern():
    first, second = without_trend(AT_30_DEGC), without_trend(AT_60_DEGC)

    assert max(correlation(first, np.roll(second, shift)) for shift in range(1, 24)) <= 0.43


def test_18_positions_for_24_save_a_quarter():
    assert 1.0 - len(POSITIONS["18"]) / len(POSITIONS["24"]) == 0.25


def test_a_rotation_of_100_arcsec_leaves_next_to_nothing_of_it_in_the_mismatch():
    """Three small angles of a matrix that is no rotation to the second order, as they stand in the published model."""
    outer_deg, inner_deg = np.array(POSITIONS["24"]).T
    gravity = directions(outer_deg, inner_deg).level
    angle = 100.0 / ARCSEC_PER_RAD
    turned = gravity @ (np.eye(3) + angle * np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])).T

    mismatch_arcsec = (np.linalg.norm(turned, axis=1) - 1.0) * ARCSEC_PER_RAD

    assert np.abs(mismatch_arcsec).max() == pytest.approx(0.024, abs=0.001)
