import pytest

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import LimitError
from tumble.drivers.manual import ManualHead


class FakeEyepiece:
    """A person whose readings are set by the test."""

    def __init__(self):
        self.shown_deg = []
        self.read_deg = None
        self.withdrawn = 0

    def show(self, setting_deg):
        self.shown_deg.append(setting_deg)
        self.read_deg = None

    def reading_deg(self):
        return self.read_deg

    def withdraw(self):
        self.withdrawn += 1


@pytest.fixture
def eyepiece():
    return FakeEyepiece()


@pytest.fixture
def head(eyepiece):
    return ManualHead(eyepiece, VirtualClock(), limits_deg=(-90.0, 400.0), speed_deg_s=2.0, serial="H-3")


def test_it_moves_until_it_was_read_and_stands_where_it_was_read(head, eyepiece):
    head.start_move(50.0)
    assert eyepiece.shown_deg == [50.0]
    assert head.status().moving
    eyepiece.read_deg = 50.001
    assert (head.status().moving, head.status().angle_deg, head.status().by_hand) == (False, 50.001, True)


def test_a_setting_at_which_it_stands_already_is_not_asked_for_again(head, eyepiece):
    head.start_move(50.0)
    eyepiece.read_deg = 50.001
    head.status()
    head.start_move(50.0)
    assert eyepiece.shown_deg == [50.0]
    assert not head.status().moving


def test_a_request_that_was_stopped_is_put_again(head, eyepiece):
    head.start_move(50.0)
    head.stop()
    assert (head.status().moving, eyepiece.withdrawn) == (False, 1)
    head.start_move(50.0)
    assert eyepiece.shown_deg == [50.0, 50.0]


@pytest.mark.parametrize("angle_deg", [-90.1, 400.5, float("nan")])
def test_a_setting_outside_the_limits_is_refused_and_not_shown(head, eyepiece, angle_deg):
    with pytest.raises(LimitError, match="outside the limits -90 to 400 deg"):
        head.start_move(angle_deg)
    assert eyepiece.shown_deg == []


def test_it_says_who_it_is_and_needs_no_reference(head):
    assert (head.identify().model, head.identify().serial) == ("manual dividing head", "H-3")
    head.home()
    assert head.status().referenced
    assert (head.limits_deg, head.speed_deg_s) == ((-90.0, 400.0), 2.0)
