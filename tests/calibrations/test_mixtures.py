"""The interval of a quantity that has one of several distributions."""

import pytest

from tumble.calibrations.core.mixtures import Part, interval_95

NORMAL = 1e12
ONE = Part(odds=1.0, value=0.0, low=-1.959964, high=1.959964)


def test_of_one_distribution_it_is_its_own():
    assert interval_95([ONE], NORMAL) == pytest.approx((-1.959964, 1.959964), abs=1e-5)


def test_an_asymmetric_one_keeps_its_ends():
    assert interval_95([Part(odds=1.0, value=2.0, low=1.0, high=6.0)], 7.0) == pytest.approx((1.0, 6.0), abs=1e-6)


def test_of_two_far_apart_it_holds_what_is_likely_of_both():
    """Each end leaves one in forty: one in twenty of that distribution alone, at 1.644854 deviations."""
    other = Part(odds=1.0, value=20.0, low=18.040036, high=21.959964)

    assert interval_95([ONE, other], NORMAL) == pytest.approx((-1.644854, 21.644854), abs=1e-5)


def test_one_with_odds_of_a_hundredth_hardly_matters():
    other = Part(odds=0.01, value=20.0, low=18.040036, high=21.959964)

    assert interval_95([ONE, other], NORMAL) == pytest.approx((-1.956, 2.15), abs=0.05)
