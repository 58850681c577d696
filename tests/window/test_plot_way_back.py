"""A plot that was zoomed shows everything again, or what it showed before, and a new run has axes of its own."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication
from pytest import approx

from tumble.window.look.plots import Plot


@pytest.fixture
def plot(qtbot):
    """A plot of a line from (0, 0) to (10, 100)."""
    plot = Plot("angle (°)", "voltage (V)")
    qtbot.addWidget(plot)
    plot.resize(400, 300)
    plot.plot([0.0, 10.0], [0.0, 100.0])
    plot.show()
    qtbot.waitUntil(lambda: plot.viewRange()[0][1] > 9.9)
    return plot


def turn_the_wheel(plot, notches):
    for _ in range(notches):
        centre = QPointF(plot.viewport().rect().center())
        event = QWheelEvent(
            centre,
            plot.viewport().mapToGlobal(centre),
            QPoint(),
            QPoint(0, 120),
            Qt.MouseButton.NoButton,
            Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(plot.viewport(), event)


def whole(plot):
    (left, right), (low, high) = plot.viewRange()
    return left <= 0.0 and right >= 10.0 and low <= 0.0 and high >= 100.0


def test_home_shows_everything_after_six_notches(plot):
    turn_the_wheel(plot, 6)
    assert not whole(plot)
    plot.way_back.home_button.click()
    assert whole(plot)


def test_home_follows_what_is_drawn_afterwards(plot):
    turn_the_wheel(plot, 2)
    plot.way_back.home()
    plot.plot([0.0, 50.0], [0.0, 100.0])
    QApplication.processEvents()
    assert plot.viewRange()[0][1] >= 50.0


def test_back_goes_one_notch_and_then_to_everything(plot):
    turn_the_wheel(plot, 1)
    zoomed = plot.viewRange()
    turn_the_wheel(plot, 1)
    plot.way_back.back_button.click()
    assert np.array(plot.viewRange()) == approx(np.array(zoomed))
    plot.way_back.back_button.click()
    assert whole(plot)


def test_the_buttons_are_there_only_where_there_is_a_way_back(plot):
    assert plot.way_back.isHidden()
    turn_the_wheel(plot, 1)
    assert not plot.way_back.isHidden()
    plot.way_back.back()
    assert plot.way_back.isHidden()


@pytest.mark.parametrize("key", [Qt.Key.Key_Home, Qt.Key.Key_Backspace])
def test_a_key_shows_everything(qtbot, plot, key):
    turn_the_wheel(plot, 1)
    qtbot.keyClick(plot, key)
    assert whole(plot)


def test_a_double_click_shows_everything(qtbot, plot):
    turn_the_wheel(plot, 3)
    qtbot.mouseDClick(plot.viewport(), Qt.MouseButton.LeftButton)
    assert whole(plot)


def test_axes_of_what_was_before_are_forgotten(plot):
    turn_the_wheel(plot, 3)
    plot.clear()
    plot.way_back.begin_anew()
    assert plot.viewRange() == [[0, 1], [0, 1]]
