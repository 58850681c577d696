from threading import Event

import pytest
from PySide6.QtCore import Qt

from tumble.calibrations.records.store import Store
from tumble.drivers.simulated.head import SimulatedHead
from tumble.procedures.events import FinishReason, State
from tumble.procedures.recording.reader import read_recording
from tumble.window.screens.run import Phase


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def recording(tmp_path):
    (path,) = (tmp_path / "store").glob("recordings/SN-1/*.mcap")
    return read_recording(path)


@pytest.fixture
def slow(driver):
    """A stand whose moves last long enough to be looked at."""
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    return driver


def reach(driver, programme, state):
    """A run in one of the states that last."""
    asked = state is State.AWAITING_OPERATOR
    driver.start(programme, imagined=not asked)
    if asked:
        driver.wait(lambda: driver.run.view.asks)
    else:
        driver.wait_for_points(2)
    if state is State.PAUSED:
        driver.press(Qt.Key.Key_F6)
        driver.wait(lambda: driver.run.course.now.state is State.PAUSED)


@pytest.mark.parametrize("state", [State.RUNNING, State.PAUSED, State.AWAITING_OPERATOR])
def test_the_stop_key_stops_in_every_state_at_a_standstill(slow, long, tmp_path, state):
    reach(slow, long, state)
    slow.press(Qt.Key.Key_F12)
    slow.wait_for_end()
    found = recording(tmp_path)
    assert found.ending.reason is FinishReason.STOPPED
    assert found.ending.at_standstill
    assert slow.complaints == []
    assert "the operator stopped the run" in slow.log
    assert Store.existing(tmp_path / "store").find() == ()


def test_a_pause_holds_and_the_run_goes_on_from_there(slow, long):
    reach(slow, long, State.PAUSED)
    points = len(slow.run.view.points)
    slow.bot.wait(300)
    assert len(slow.run.view.points) == points
    assert slow.run.controls.resume.isEnabled()
    assert not slow.run.controls.pause.isEnabled()
    slow.press(Qt.Key.Key_F7)
    slow.wait_for_points(points + 2)
    assert slow.run.course.now.state is State.RUNNING


def test_a_pause_while_a_mount_is_asked_for_is_heeded_after_the_answer(slow, long):
    reach(slow, long, State.AWAITING_OPERATOR)
    slow.press(Qt.Key.Key_F6)
    slow.press(Qt.Key.Key_F9)
    slow.wait(lambda: slow.run.course.now.state is State.PAUSED)
    assert slow.run.view.points == []
    slow.press(Qt.Key.Key_F7)
    slow.wait_for_points(1)


def assert_ended(driver):
    driver.wait(lambda: not driver.window.busy, 10)
    assert driver.run.phase is Phase.IDLE
    assert driver.run.controls.start.isEnabled()
    assert driver.complaints == []


def test_a_run_that_is_stopped_while_it_connects_is_over(driver, long, reaching):
    driver.start(long)
    driver.wait(reaching.is_set)
    driver.press(Qt.Key.Key_F12)
    assert_ended(driver)


def test_a_run_that_is_stopped_before_its_turn_has_come_is_over(driver, long):
    hold = Event()
    driver.window.worker._thread.put(hold.wait, lambda _: None)
    driver.start(long)
    driver.press(Qt.Key.Key_F12)
    hold.set()
    assert_ended(driver)


def test_stop_before_anything_is_connected_does_nothing(driver):
    driver.press(Qt.Key.Key_F12)
    driver.wait(lambda: not driver.window.busy)
    assert driver.complaints == []


def test_the_button_stops_a_jog(slow):
    stand = slow.window.stand
    slow.window.open(stand)
    stand.connect_button.click()
    slow.wait(stand.jog.isEnabled)
    stand.jog.angle.setText("700")
    slow.press(Qt.Key.Key_F8)
    slow.wait(lambda: slow.window.busy)
    slow.bot.mouseClick(slow.window.stop_bar.button, Qt.MouseButton.LeftButton)
    slow.wait(lambda: not slow.window.busy)
    slow.bot.wait(300)
    assert stand.dials.of("head").accessibleName() != "700.0000°"


def test_the_stop_key_stops_a_run_with_a_notice_open_which_stays(slow, long, tmp_path):
    reach(slow, long, State.RUNNING)
    slow.window.tell(ValueError("something else"))
    slow.bot.keyClick(slow.window.windowHandle(), Qt.Key.Key_F12)
    slow.wait_for_end()
    assert recording(tmp_path).ending.reason is FinishReason.STOPPED
    assert len(slow.complaints) == 1


@pytest.mark.parametrize("leaves", [True, False])
def test_closing_during_a_run_asks(slow, long, tmp_path, leaves):
    reach(slow, long, State.RUNNING)
    slow.window.close()
    assert len(slow.window.dialogs.open) == 1
    assert slow.window.isVisible()
    slow.press(Qt.Key.Key_F3 if leaves else Qt.Key.Key_Escape)
    if not leaves:
        assert slow.window.dialogs.open == []
        assert slow.run.phase is Phase.RUNNING
        return
    slow.wait(lambda: not slow.window.isVisible())
    found = recording(tmp_path)
    assert found.ending.reason is FinishReason.STOPPED
    assert found.ending.at_standstill


def test_a_head_that_still_turns_when_the_window_is_left_is_stopped(slow, monkeypatch):
    stopped = []
    stop = SimulatedHead.stop
    monkeypatch.setattr(SimulatedHead, "stop", lambda head: (stopped.append(head), stop(head))[1])
    stand = slow.window.stand
    stand.connect_button.click()
    slow.wait(stand.jog.isEnabled)
    slow.window.worker.move_to("head", 700.0)
    slow.wait(lambda: slow.window.busy)
    slow.window.leave()
    slow.wait(lambda: not slow.window.isVisible())
    assert not stopped[-1].status().moving
