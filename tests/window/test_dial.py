"""The dial: where the head is, and where it was sent."""

import pytest
from PySide6.QtCore import QPointF, QSize
from PySide6.QtGui import QColor

from tumble.drivers.protocols import PositionerStatus
from tumble.window.look.theme import colours
from tumble.window.widgets.dial import Dial


@pytest.fixture
def dial(qtbot):
    shown = Dial()
    qtbot.addWidget(shown)
    shown.resize(QSize(400, 400))
    shown.show()
    return shown


def at(angle_deg, target_deg=None, *, moving=False, referenced=True):
    return PositionerStatus(
        angle_deg=angle_deg, moving=moving, device_time_s=0.0, referenced=referenced, target_deg=target_deg
    )


def seen(dial, x, y):
    """Colour of a place, in parts of the radius from the centre, to the right and downwards."""
    picture = dial.grab().toImage()
    place = QPointF(200, 200) + QPointF(x, y) * 194
    return QColor(picture.pixel(place.toPoint()))


def test_where_it_is_is_filled_and_where_it_was_sent_is_hollow(dial):
    dial.show_status(at(0.0, 90.0))
    chosen = colours(dial)
    assert seen(dial, 0.0, -0.75) == QColor(chosen.accent)
    assert seen(dial, 0.88, 0.03) == QColor(chosen.paper)
    edge = [seen(dial, 0.88, half / 200) for half in range(8, 18)]
    assert QColor(chosen.ink) in edge


@pytest.mark.parametrize(("angle_deg", "is_written"), [(90.0, False), (-270.0, False), (99.0, False), (105.0, True)])
def test_a_label_that_the_needle_would_lie_on_is_left_out(dial, angle_deg, is_written):
    dial.show_status(at(angle_deg))
    chosen, letters = colours(dial), [(0.72 + x / 200, y / 100) for x in range(24) for y in range(-3, 4)]
    assert (QColor(chosen.ink) in [seen(dial, x, y) for x, y in letters]) is is_written


def test_a_head_that_turns_has_another_colour(dial):
    dial.show_status(at(0.0, 90.0, moving=True))
    assert seen(dial, 0.0, -0.75) == QColor(colours(dial).now)


@pytest.mark.parametrize(
    ("status", "said"),
    [
        (at(12.5), "12.5000°"),
        (at(12.5, 90.0), "12.5000°, sent to 90.0000°"),
        (at(90.0004, 90.0), "90.0004°"),
        (at(12.5, 90.0, referenced=False), ""),
        (None, ""),
    ],
)
def test_what_it_says_to_a_screen_reader(dial, status, said):
    dial.show_status(status)
    assert dial.accessibleName() == said


@pytest.mark.parametrize("target_deg", [0.0, 90.0])
def test_nothing_is_drawn_of_a_head_that_does_not_know_its_angle(dial, target_deg):
    dial.show_status(at(0.0, referenced=False))
    unknown = dial.grab().toImage()
    dial.show_status(at(0.0, target_deg, referenced=False))
    assert dial.grab().toImage() == unknown
