"""That the head stands is said once that was read back, and the window is closed once it does."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt

from tumble.drivers.simulated.head import SimulatedHead
from tumble.procedures.events import State

UNREAD = "its standstill could not be read back"


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


@pytest.fixture
def restless(driver):
    """Makes a head that never says that it stands, until the window is left."""
    status = SimulatedHead.status
    with pytest.MonkeyPatch.context() as patched:
        yield lambda: patched.setattr(SimulatedHead, "status", lambda head: replace(status(head), moving=True))


@pytest.fixture
def running(driver, long):
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    driver.start(long)
    driver.wait_for_points(1)
    return driver


@pytest.fixture
def connected(driver):
    driver.window.stand.connect_button.click()
    driver.wait(driver.window.stand.jog.isEnabled)
    return driver


def said(driver):
    return driver.window.stop_bar.state.text()


def test_it_pauses_until_the_standstill_was_read_back_and_shows_where_that_is(running):
    texts = []
    running.run.state_changed.connect(lambda text, _fault: texts.append(text))
    running.press(Qt.Key.Key_F6)
    running.wait(lambda: running.run.course.now.state is State.PAUSED)
    assert list(dict.fromkeys(texts))[-2:] == ["Pausing…", "Paused at a standstill"]
    head = running.window.worker.session.connected.stand.positioners["head"].status()
    for dial in (running.run.view.dials.of("head"), running.window.stand.dials.of("head")):
        assert (dial._status.angle_deg, dial._status.moving) == (head.angle_deg, False)


def test_a_pause_is_taken_back_before_it_begins(running):
    running.press(Qt.Key.Key_F6)
    running.wait(lambda: said(running).startswith("Paus"))
    running.press(Qt.Key.Key_F7)
    running.wait(lambda: said(running) == "Measuring")
    running.wait_for_points(len(running.run.view.points) + 1)


def test_a_pause_without_a_standstill_is_a_red_fault(running, restless):
    restless()
    running.press(Qt.Key.Key_F6)
    running.wait(lambda: running.complaints)
    assert any(UNREAD in told for told in running.complaints)
    assert said(running) == "Fault: the standstill was not read back"
    assert running.window.stop_bar.state.objectName() == "fault"
    assert "Paused" not in running.log


def test_a_stop_without_a_standstill_is_a_red_fault_until_rest_is_seen(connected, monkeypatch):
    status = SimulatedHead.status
    monkeypatch.setattr(SimulatedHead, "status", lambda head: replace(status(head), moving=True))
    connected.window.worker.stop()
    connected.wait(lambda: connected.complaints)
    assert UNREAD in connected.complaints[0]
    assert said(connected).startswith("Fault")
    monkeypatch.setattr(SimulatedHead, "status", status)
    connected.wait(lambda: said(connected) == "Ready")


def test_a_window_at_a_restless_head_stays_once_and_says_so(connected, restless):
    restless()
    connected.window.close()
    connected.wait(lambda: connected.complaints)
    assert UNREAD in connected.complaints[0]
    assert connected.window.isVisible()
    connected.window.close()
    connected.wait(lambda: not connected.window.isVisible())


def test_closing_while_a_jog_moves_the_head_asks_stops_and_closes(connected):
    stand = connected.window.stand
    stand.simulation.speed.setCurrentIndex(2)
    connected.wait(stand.connect_button.isEnabled)
    stand.connect_button.click()
    connected.wait(stand.jog.isEnabled)
    head = connected.window.worker.session.connected.stand.positioners["head"]
    connected.window.worker.move_to("head", 700.0)
    connected.wait(lambda: head.status().moving)
    connected.window.close()
    assert connected.window.isVisible()
    connected.press(Qt.Key.Key_F3)
    connected.wait(lambda: not connected.window.isVisible())
    assert not head.status().moving
    assert head.status().angle_deg < 700.0


class Manager:
    """What Qt hands over where the system ends the session."""

    cancelled = False

    def allowsInteraction(self):  # noqa: N802  # Qt's name
        return True

    def cancel(self):
        self.cancelled = True


def test_the_end_of_a_session_brings_the_head_to_rest_first(connected):
    manager, head = Manager(), connected.window.worker.session.connected.stand.positioners["head"]
    head.start_move(700.0)
    connected.running.end_session(manager)
    assert not head.status().moving
    assert not manager.cancelled
    connected.wait(lambda: not connected.window.isVisible())


def test_the_end_of_a_session_is_put_off_where_the_head_may_still_move(connected, restless):
    restless()
    manager = Manager()
    connected.running.end_session(manager)
    assert manager.cancelled
    connected.wait(lambda: connected.complaints)
