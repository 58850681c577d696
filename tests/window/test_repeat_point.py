"""The last point of a run, taken again by a key."""

import pytest
from PySide6.QtCore import Qt

from tumble.procedures.events import RetakeBegun, State
from tumble.procedures.recording.reader import read_recording
from tumble.window.screens.run import Phase

FLIPS = """\
name = "flips"
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "flip"
axes = ["y", "z"]
"""
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


@pytest.fixture
def slow(driver):
    """A stand whose moves last long enough to be looked at."""
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    return driver


@pytest.fixture
def flips(write):
    """Programme of two dwells in either of two mounts."""
    return write("flips.toml", FLIPS)


def recording(tmp_path):
    (path,) = (tmp_path / "store").glob("recordings/SN-1/*.mcap")
    return read_recording(path)


def pause(driver):
    driver.press(Qt.Key.Key_F6)
    driver.wait(lambda: driver.run.course.now.state is State.PAUSED)


def repeat(driver):
    driver.press(Qt.Key.Key_F7, CTRL)
    driver.wait(lambda: driver.run.course.now.repeating)


def test_the_key_has_the_last_point_taken_again_and_the_run_goes_on(slow, long, tmp_path):
    slow.start(long)
    slow.wait_for_points(2)
    pause(slow)
    last = slow.run.view.points[-1]
    repeat(slow)
    assert slow.run.course.now.text == "Paused; then the last point again"
    slow.press(Qt.Key.Key_F7)
    slow.wait_for_points(last.index + 3)
    again = slow.run.view.points[last.index]
    assert (again.index, again.take) == (last.index, 2)
    assert [point.index for point in slow.run.view.points] == list(range(len(slow.run.view.points)))
    assert f"Point {last.index} is taken again." in slow.log
    assert "was taken again as the operator wished; the later reading is used" in slow.log
    assert slow.run.view.overview.done == len(slow.run.view.points)
    slow.press(Qt.Key.Key_F12)
    slow.wait_for_end()
    found = recording(tmp_path)
    assert RetakeBegun(point=last.index) in found.events
    assert found.points[last.index] == again


def test_it_can_be_pressed_once_for_each_taking(slow, long):
    slow.start(long)
    slow.wait_for_points(1)
    pause(slow)
    button = slow.run.controls.again
    assert button.isEnabled()
    repeat(slow)
    assert not button.isEnabled()
    slow.press(Qt.Key.Key_F7)
    slow.wait(button.isEnabled)


def test_without_a_point_there_is_none_to_be_repeated(slow, long):
    assert not slow.run.controls.again.isEnabled()
    slow.start(long, imagined=False)
    slow.wait(lambda: slow.run.view.asks)
    assert not slow.run.controls.again.isEnabled()


def test_a_question_that_is_open_gives_way_to_the_mount_of_the_point(slow, flips, tmp_path):
    slow.start(flips, imagined=False)
    slow.wait(lambda: slow.run.view.asks)
    slow.press(Qt.Key.Key_F9)
    slow.wait(lambda: slow.run.view.asks and len(slow.run.view.points) == 2)
    repeat(slow)
    slow.wait(lambda: "Point 1 is taken again." in slow.log and slow.run.view.asks)
    slow.press(Qt.Key.Key_F9)
    slow.wait(lambda: slow.run.view.asks and slow.run.view.points[-1].take == 2)
    slow.press(Qt.Key.Key_F9)
    slow.wait(lambda: slow.run.phase is not Phase.RUNNING)
    asked = [answer.value for answer in recording(tmp_path).answers]
    assert asked == ["face-up", "face-up", "edge"]
