"""What the surroundings are expected to be like later."""

import numpy as np
import pytest

from tumble.calibrations.core.surroundings import typical_course

TABLE_S = np.arange(0.0, 1200.0, 2.0)
LATER_S = TABLE_S[-1] + 7200.0 + np.arange(0.0, 600.0, 2.0)


def off_one_line(values, later, later_s=LATER_S, then_s=TABLE_S):
    """Root mean square distance of everything from one line."""
    whole_s, both = np.concatenate([then_s, later_s]), np.concatenate([values, later])
    return np.std(both - np.polynomial.Polynomial.fit(whole_s, both, 1)(whole_s))


def walked(seed, time_s, step):
    """A room that warms by 3 K/h and walks by `step` K in the root of a second, read to 0.01 K."""
    chance = np.random.default_rng(seed)
    moves = step * np.sqrt(np.diff(time_s, prepend=time_s[0])) * chance.standard_normal(len(time_s))
    return 23.0 + time_s / 1200.0 + np.cumsum(moves) + 0.01 * chance.standard_normal(len(time_s))


def test_a_room_without_wandering_goes_on_along_its_line():
    assert typical_course(TABLE_S, 20.0 + TABLE_S / 3600.0, LATER_S) == pytest.approx(20.0 + LATER_S / 3600.0)


def test_the_noise_of_the_thermometer_is_no_wandering():
    noise = 0.01 * np.random.default_rng(11).standard_normal(len(TABLE_S))
    later = typical_course(TABLE_S, 20.0 + noise, LATER_S)
    assert off_one_line(20.0 + noise, later) < 0.011


def test_a_room_departs_as_often_more_as_less_from_what_is_expected():
    whole_s = np.concatenate([TABLE_S, LATER_S])
    more = 0
    for seed in range(200):
        room = walked(seed, whole_s, 0.003)
        then, later = np.split(room, [len(TABLE_S)])
        more += off_one_line(then, later) > off_one_line(then, typical_course(TABLE_S, then, LATER_S))
    assert 75 <= more <= 125


def test_a_thermometer_of_coarse_steps_does_not_wander():
    then = np.round(20.0 + TABLE_S / 3600.0, 1)
    assert off_one_line(then, typical_course(TABLE_S, then, LATER_S)) < 0.05


def test_a_pause_in_the_table_is_not_taken_for_noise():
    then_s = np.concatenate([TABLE_S, LATER_S])
    later_s = then_s[-1] + 60.0 + np.arange(0.0, 600.0, 2.0)
    then = walked(3, then_s, 0.003)
    assert off_one_line(then, typical_course(then_s, then, later_s), later_s, then_s) > 0.02


def test_the_same_values_give_the_same_course():
    then = walked(5, TABLE_S, 0.003)
    assert typical_course(TABLE_S, then, LATER_S).tolist() == typical_course(TABLE_S, then, LATER_S).tolist()


def test_the_order_of_the_rows_does_not_matter():
    then, order = walked(5, TABLE_S, 0.003), np.random.default_rng(2).permutation(len(TABLE_S))
    mixed = typical_course(TABLE_S[order], then[order], LATER_S)
    assert mixed.tolist() == typical_course(TABLE_S, then, LATER_S).tolist()


def test_rows_at_two_times_show_a_line_and_no_wandering():
    then_s, noise = np.repeat([0.0, 3600.0], 30), 0.001 * np.random.default_rng(4).standard_normal(60)
    later = typical_course(then_s, np.repeat([20.0, 21.0], 30) + noise, LATER_S)
    assert later == pytest.approx(20.0 + LATER_S / 3600.0, abs=0.01)
