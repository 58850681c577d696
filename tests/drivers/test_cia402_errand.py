"""When homing or a move is over, by statuswords that lag behind and flicker (public reports; positions in counts)."""

import pytest

from tumble.drivers.cia402.errand import LINGER_S, Errand

HOMED, UNDER_WAY, ARRIVED = 0x1637, 0x0237, 0x0637
WINDOW = 5


def told(errand: Errand, *looks: tuple[float, int, int]) -> list[bool]:
    """What is thought of statuswords and positions at some times."""
    return [errand.over(statusword, counts, time_s) for time_s, statusword, counts in looks]


def homing(start: int = 0) -> Errand:
    return Errand(start, WINDOW, 0.0, homing=True)


def move(start: int, target: int) -> Errand:
    return Errand(start, WINDOW, 0.0, target=target)


@pytest.mark.parametrize("lag_s", [0.002, 0.3])
def test_homing_is_over_when_the_bits_have_gone_and_come_again(lag_s: float):
    looks = [(0.0, HOMED, 0), (lag_s, UNDER_WAY, -40), (1.0, UNDER_WAY, -900), (1.5, HOMED, 0)]
    assert told(homing(), *looks) == [False, False, False, True]


def test_homing_that_takes_no_time_is_over_once_the_drive_has_said_so_for_long():
    looks = [(0.0, HOMED, 0), (0.9 * LINGER_S, HOMED, 0), (LINGER_S, HOMED, 0)]
    assert told(homing(), *looks) == [False, False, True]


def test_homing_is_not_over_while_the_axis_turns_whatever_the_bits_say():
    looks = [(0.4 * i, HOMED, -100 * i) for i in range(10)]
    assert not any(told(homing(), *looks))


def test_the_arrived_bit_of_the_move_before_is_no_homing():
    assert told(homing(), (0.0, ARRIVED, 0), (0.01, HOMED, 0)) == [False, False]


def test_a_homing_that_failed_and_stands_is_over_and_found_nothing():
    errand = homing()
    assert told(errand, (0.0, UNDER_WAY, 0), (0.1, 0x2637, 0)) == [False, True]
    assert not errand.homed(0x2637, 0, 0.1)


def test_a_move_is_not_over_while_an_old_bit_says_arrived():
    looks = [(0.0, ARRIVED, 0), (0.3, ARRIVED, 300), (0.31, UNDER_WAY, 310), (1.0, ARRIVED, 1000)]
    assert told(move(0, 1000), *looks) == [False, False, False, True]


def test_a_move_to_where_the_axis_is_takes_no_time():
    assert told(move(1000, 1000), (0.0, ARRIVED, 1000)) == [True]


def test_a_move_that_ends_elsewhere_is_over_all_the_same():
    assert told(move(0, 1000), (0.1, UNDER_WAY, 500), (0.2, ARRIVED, 1500)) == [False, True]


def test_a_flickering_bit_before_the_axis_has_left_does_not_show_that_it_has_begun():
    assert told(move(0, 1000), (0.0, UNDER_WAY, 0), (0.01, ARRIVED, 0)) == [False, False]


def test_a_bit_that_flickers_at_rest_is_no_motion():
    looks = [(0.1, UNDER_WAY, 500), (0.2, ARRIVED, 1000), (0.3, UNDER_WAY, 1001), (0.4, ARRIVED, 999)]
    assert told(move(0, 1000), *looks) == [False, True, True, True]


def test_an_axis_that_leaves_its_place_moves():
    assert told(move(0, 1000), (0.2, ARRIVED, 1000), (0.3, UNDER_WAY, 1100)) == [True, False]
