"""A disturbance that lasts over several dwells: what is set aside, and what the others of it weigh."""

import numpy as np
import pytest

from tumble.calibrations.core.gross import burst
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.weights import dwell_weights

NOISE_V = 1e-4
POSES, VISITS = 24, 5
GROUPS = np.tile(np.arange(POSES), VISITS)
BURST = np.array([50, 51, 52, 53])


def observations(sd_v):
    angle_deg = 15.0 * GROUPS
    return Observations(row=np.arange(2, 2 + len(angle_deg)), angle_deg=angle_deg, voltage_sd_v=sd_v)


def noise_v(seed):
    return np.random.default_rng(seed).normal(0.0, NOISE_V, POSES * VISITS)


def disturbed_sd_v():
    sd_v = np.full(POSES * VISITS, 1e-3)
    sd_v[BURST] = 8e-3
    return sd_v


def rows(*numbers):
    return np.isin(np.arange(12), numbers)


@pytest.mark.parametrize(
    ("gross", "doubtful", "set_aside"),
    [
        ((5,), (), (5,)),
        ((5,), (7,), (5,)),
        ((5,), (7, 8), (5, 6, 7, 8)),
        ((5,), (3, 7, 8), (3, 4, 5, 6, 7, 8)),
        ((5,), (8, 9), (5,)),
        ((), (5, 6), ()),
        ((2, 9), (), (2, 9)),
    ],
    ids=["alone", "one near", "two near", "a chain", "too far", "none is gross", "two apart"],
)
def test_a_burst_is_what_lies_near_a_gross_error_and_is_doubtful(gross, doubtful, set_aside):
    found = burst(rows(*gross), rows(*doubtful), None)

    assert np.flatnonzero(found).tolist() == list(set_aside)


def test_a_burst_follows_the_clock_and_not_the_order_of_rows():
    found = burst(rows(0), rows(10, 11), time_s=np.array([10, *range(50, 59), 12.0, 11.0]))

    assert np.flatnonzero(found).tolist() == [0, 10, 11]


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_table_shorter_than_a_burst_is_looked_at_too(count):
    nothing = np.zeros(count, dtype=bool)

    assert burst(~nothing, nothing, None).tolist() == [True] * count


def test_disturbed_dwells_that_scatter_more_weigh_less():
    residual_v = noise_v(1)
    residual_v[BURST] += np.array([6, -7, 5, -8]) * NOISE_V

    weights = dwell_weights(observations(disturbed_sd_v()), residual_v, GROUPS)

    assert weights[BURST].max() < 0.1 * np.median(weights)


def test_disturbed_samples_alone_are_no_reason_to_weigh_a_dwell_less():
    weights = dwell_weights(observations(disturbed_sd_v()), noise_v(2), GROUPS)

    assert weights == pytest.approx(np.ones(POSES * VISITS))


def test_what_goes_with_the_power_of_the_samples_is_an_effect_and_no_noise():
    sd_v = disturbed_sd_v()
    sd_v[BURST] = [4e-3, 8e-3, 6e-3, 5e-3]
    residual_v = noise_v(3) + 12 * NOISE_V * (sd_v / 8e-3) ** 2

    assert dwell_weights(observations(sd_v), residual_v, GROUPS) == pytest.approx(np.ones(POSES * VISITS))


def test_a_dwell_of_which_no_samples_are_known_weighs_as_others():
    sd_v = disturbed_sd_v()
    sd_v[:3] = np.nan
    residual_v = noise_v(1)
    residual_v[BURST] += np.array([6, -7, 5, -8]) * NOISE_V

    weights = dwell_weights(observations(sd_v), residual_v, GROUPS)

    assert weights[:3] == pytest.approx([weights[10]] * 3)
