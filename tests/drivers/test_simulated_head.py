"""The simulated head in virtual time: motion, reading, limits, errors."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import LimitError
from tumble.drivers.simulated.effects import Effects
from tumble.drivers.simulated.head import HeadErrors, HeadOptions, Move, SimulatedHead


def head(clock: VirtualClock, **options) -> SimulatedHead:
    return SimulatedHead(clock, HeadOptions(**options), lambda: None)


def error_deg(effects, angle_deg, direction=1, external=None) -> float:
    errors = HeadErrors(Effects.model_validate(effects), external)
    return float(errors.error_deg(np.array([angle_deg]), direction, np.array([7.0]))[0])


def test_a_move_takes_its_time_and_arrives():
    clock = VirtualClock()
    subject = head(clock, speed_deg_s=20.0)
    subject.start_move(-90.0)
    clock.sleep(2.0)
    assert (subject.status().angle_deg, subject.status().moving) == (-40.0, True)
    clock.sleep(2.5)
    assert (subject.status().angle_deg, subject.status().moving) == (-90.0, False)
    assert subject.status().device_time_s == 4.5


def test_revolutions_are_kept():
    clock = VirtualClock()
    subject = head(clock)
    subject.start_move(395.0)
    clock.sleep(60.0)
    assert subject.status().angle_deg == 395.0


@pytest.mark.parametrize("steps_per_deg", [4.0, -4.0])
def test_the_reading_is_in_whole_counts(steps_per_deg):
    clock = VirtualClock()
    subject = head(clock, steps_per_deg=steps_per_deg, speed_deg_s=1.0)
    subject.start_move(1.13)
    clock.sleep(0.6)
    assert subject.status().angle_deg == 0.5
    clock.sleep(1.0)
    assert subject.status().angle_deg == 1.25


@pytest.mark.parametrize("angle_deg", [-180.1, 760.1, float("nan"), float("inf")])
def test_a_move_outside_the_limits_is_refused_and_nothing_moves(angle_deg):
    subject = head(VirtualClock())
    with pytest.raises(LimitError, match="outside the limits -180 to 760 deg"):
        subject.start_move(angle_deg)
    assert not subject.status().moving


@pytest.mark.parametrize("angle_deg", [-180.0, 760.0])
def test_a_move_to_a_limit_is_allowed(angle_deg):
    subject = head(VirtualClock())
    subject.start_move(angle_deg)
    assert subject.status().moving


def test_stop_halts_where_the_head_is():
    clock = VirtualClock()
    subject = head(clock, speed_deg_s=20.0)
    subject.start_move(100.0)
    clock.sleep(1.5)
    subject.stop()
    assert not subject.status().moving
    clock.sleep(10.0)
    assert subject.status().angle_deg == 30.0


def test_home_goes_to_zero_even_where_the_limits_exclude_it():
    clock = VirtualClock()
    subject = head(clock, limits_deg=(5.0, 90.0))
    subject.start_move(40.0)
    clock.sleep(2.0)
    subject.home()
    clock.sleep(2.0)
    assert subject.status().angle_deg == 0.0


def test_the_direction_is_that_of_the_last_move_that_moved():
    clock = VirtualClock()
    subject = head(clock)
    assert subject.direction == 0
    subject.start_move(-10.0)
    clock.sleep(1.0)
    subject.start_move(-10.0)
    assert subject.direction == -1
    subject.start_move(5.0)
    assert subject.direction == 1


def test_it_says_who_it_is():
    assert head(VirtualClock()).identify().model == "tumble simulated head"


def test_the_output_follows_with_a_first_order_lag():
    move = Move(start_deg=0.0, end_deg=-20.0, started_s=100.0, speed_deg_s=20.0)
    times_s = np.array([100.0, 100.9, 101.0, 101.03, 102.0])
    lag_deg = move.sensed_deg(times_s, 0.03) - np.array([0.0, -18.0, -20.0, -20.0, -20.0])
    assert lag_deg == pytest.approx([0.0, 0.6, 0.6, 0.6 / np.e, 0.0], abs=1e-9)


def test_an_output_without_a_time_constant_does_not_lag():
    move = Move(start_deg=0.0, end_deg=20.0, started_s=0.0, speed_deg_s=20.0)
    assert move.sensed_deg(np.array([0.25, 0.5, 2.0]), 0.0).tolist() == [5.0, 10.0, 20.0]


@given(st.floats(-100.0, 100.0), st.floats(-100.0, 100.0), st.floats(0.0, 30.0))
def test_a_head_on_its_way_is_between_start_and_end(start_deg, end_deg, time_s):
    move = Move(start_deg=start_deg, end_deg=end_deg, started_s=0.0, speed_deg_s=10.0)
    low_deg, high_deg = sorted((start_deg, end_deg))
    assert low_deg - 1e-9 <= move.angle_deg(time_s) <= high_deg + 1e-9


@pytest.mark.parametrize(
    ("effects", "angle_deg", "expected_deg"),
    [
        ({"head_eccentricity": {"amplitude_deg": 0.01, "phase_deg": 30.0}}, 60.0, 0.01),
        ({"head_eccentricity": {"amplitude_deg": 0.01, "phase_deg": 30.0}}, 0.0, 0.005),
        ({"head_second_harmonic": {"amplitude_deg": 0.01, "phase_deg": 30.0}}, 30.0, 0.01),
        ({"graduation": {"order": 5, "amplitude_deg": 0.01, "phase_deg": 0.0}}, 18.0, 0.01),
        ({}, 18.0, 0.0),
    ],
)
def test_the_head_errs_with_its_own_angle(effects, angle_deg, expected_deg):
    assert error_deg(effects, angle_deg) == pytest.approx(expected_deg)


@pytest.mark.parametrize(("direction", "expected_deg"), [(1, 0.0), (0, 0.0), (-1, 0.002)])
def test_backlash_comes_after_moves_in_minus_direction(direction, expected_deg):
    assert error_deg({"backlash": 0.002}, 10.0, direction) == expected_deg


def test_an_external_error_adds_to_the_others():
    def external(angle_deg: float, direction: int, time_s: float) -> float:
        return angle_deg + 100.0 * direction + 1000.0 * time_s

    assert error_deg({"backlash": 0.5}, 10.0, -1, external) == pytest.approx(6910.5)
