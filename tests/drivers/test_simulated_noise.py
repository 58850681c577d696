"""Noise that can be repeated, with the size that it claims."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.simulated.noise import RandomWalk, Stream, Wander, flicker, generator, interpolated

TIMES_S = st.lists(st.floats(8000.0, 8010.0), min_size=1, max_size=5).map(lambda times: np.array(sorted(times)))


def allan_deviation(values, window) -> float:
    """Overlapping Allan deviation of evenly spaced values for a window of so many."""
    summed = np.concatenate([[0.0], np.cumsum(values)])
    means = (summed[window:] - summed[:-window]) / window
    return float(np.sqrt(0.5 * np.mean((means[window:] - means[:-window]) ** 2)))


def test_a_draw_belongs_to_its_seed_stream_and_number():
    drawn = {
        float(generator(seed, stream, number).random())
        for seed in (1, 2)
        for stream in (Stream.SAMPLES, Stream.SEATING)
        for number in (0, 1)
    }
    assert len(drawn) == 8
    assert generator(1, Stream.SAMPLES, 7).random() == generator(1, Stream.SAMPLES, 7).random()


@pytest.fixture(scope="module")
def flickering_v():
    """Flicker of four seeds, every second of half a day."""
    return [flicker(seed, 1e-4).at(np.arange(40000.0)) for seed in range(4)]


@pytest.mark.parametrize("window_s", [10, 100, 1000])
def test_flicker_has_the_allan_floor_that_is_asked_for(flickering_v, window_s):
    deviations_v = [allan_deviation(values_v, window_s) for values_v in flickering_v]
    assert np.sqrt(np.mean(np.square(deviations_v))) == pytest.approx(1e-4, rel=0.2)


def test_no_flicker_is_asked_for_by_default():
    assert flicker(1, 0.0).at(np.array([1.0, 2.0])).tolist() == [0.0, 0.0]


@given(TIMES_S)
def test_flicker_is_a_function_of_time_alone(times_s):
    asked_before = flicker(3, 1.0)
    asked_before.at(np.array([5000.0, 5001.0]))
    one_by_one = [float(flicker(3, 1.0).at(np.array([time_s]))[0]) for time_s in times_s]
    assert asked_before.at(times_s).tolist() == pytest.approx(one_by_one, abs=1e-9)


@given(TIMES_S)
def test_a_random_walk_is_a_function_of_time_alone(times_s):
    asked_before = RandomWalk(3, v_per_sqrt_h=1.0)
    asked_before.at(np.array([9000.0]))
    assert asked_before.at(times_s).tolist() == RandomWalk(3, v_per_sqrt_h=1.0).at(times_s).tolist()


def test_a_random_walk_spreads_with_the_root_of_time():
    after_v = np.array([RandomWalk(seed, v_per_sqrt_h=1e-4).at(np.array([3600.0, 14400.0])) for seed in range(400)])
    assert after_v.std(axis=0) == pytest.approx([1e-4, 2e-4], rel=0.12)


def test_a_random_walk_begins_at_zero():
    assert RandomWalk(1, v_per_sqrt_h=1.0).at(np.array([0.0])).tolist() == [0.0]


def test_a_wander_has_the_root_mean_square_that_is_asked_for():
    wander = Wander(generator(1, Stream.ROOM), rms=0.05, band_hz=(1e-4, 1e-2))
    assert wander.at(np.arange(0.0, 1e6, 10.0)).std() == pytest.approx(0.05, rel=0.05)


def test_interpolation_is_exact_on_straight_lines():
    times_s = np.array([0.0, 0.3, 5.0])
    assert interpolated(lambda t: 2.0 * t + 1.0, times_s, 1.0) == pytest.approx([1.0, 1.6, 11.0])


def test_interpolation_takes_its_nodes_at_whole_steps():
    assert interpolated(lambda t: t**2, np.array([4.5]), 1.0).tolist() == [20.5]
