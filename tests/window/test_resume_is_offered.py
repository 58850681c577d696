"""A run that was stopped or broke off is offered on the screen Run, and after a crash at the start."""

import pytest
from PySide6.QtCore import Qt
from window_driver import TINY

from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.procedures.events import RunFinished
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.recording.writer import Recorder


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


@pytest.fixture
def interrupted(driver, tiny, tmp_path, monkeypatch):
    """A run of which a fault has left two points."""
    return interrupt(driver, tiny, tmp_path, monkeypatch, 2)


def interrupt(driver, tiny, tmp_path, monkeypatch, points):
    acquire, calls = SimulatedDaq.acquire, []

    def failing(*arguments):
        calls.append(arguments)
        if len(calls) == 3 * points + 2:
            raise DeviceError("voltmeter", "does not answer", "check its cable, then resume the run")
        return acquire(*arguments)

    monkeypatch.setattr(SimulatedDaq, "acquire", failing)
    driver.start(tiny)
    driver.wait_for_end()
    monkeypatch.undo()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    (path,) = (tmp_path / "store").glob("recordings/SN-1/*.mcap")
    return driver, path


def test_a_run_that_a_fault_ended_goes_on_where_one_stands(interrupted, no_report):
    driver, _ = interrupted
    driver.wait(driver.run.offered.isVisible)
    text = driver.run.offered.text()
    assert text.startswith("Stopped: unit SN-1, programme tiny, 2 points done at the stand simulated, begun 2")
    assert text.endswith(": device fault.")
    driver.dismiss_all()
    driver.press(Qt.Key.Key_F7)
    presentation = driver.wait_for_result()
    assert presentation.concluded.record_id
    driver.window.open(driver.run)
    assert not driver.run.offered.isVisible()


def test_a_run_that_was_stopped_is_offered_and_can_be_left(driver, write, tmp_path):
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    driver.start(write("long.toml", TINY.replace("points = 6", "points = 600").replace("60.0", "1.0")))
    driver.wait_for_points(1)
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    driver.wait(driver.run.offered.isVisible)
    assert "kept. F7 goes on, or " in driver.log
    assert "tumble resume" not in driver.log
    driver.run.offered._decline()
    driver.window.records.refresh()
    driver.wait(lambda: driver.window.records.cut_off.table.rowCount() == 1)
    assert not driver.run.offered.isVisible()


def test_what_there_is_of_a_run_is_analysed_and_recorded(driver, tiny, tmp_path, monkeypatch, no_report):
    _, path = interrupt(driver, tiny, tmp_path, monkeypatch, 5)
    driver.wait(driver.run.offered.isVisible)
    driver.dismiss_all()
    driver.run.offered.analyse_button.click()
    concluded = driver.wait_for_result().concluded
    assert (concluded.recordings, bool(concluded.record_id)) == ((path,), True)
    driver.wait(lambda: driver.window.records.records)
    assert not driver.window.records.records[0].complete
    assert driver.window.records.table.texts()[0][4].startswith("⚠")


def test_what_cannot_be_analysed_is_told(driver, tmp_path):
    driver.window.run.offered.analysis_wanted.emit(tmp_path / "absent.mcap")
    driver.wait(lambda: bool(driver.complaints))
    assert "absent.mcap" in driver.complaints[0]


def test_a_run_that_is_discarded_lies_aside_and_is_not_offered_again(interrupted, tmp_path):
    driver, path = interrupted
    driver.wait(driver.run.offered.isVisible)
    while driver.window.dialogs.close_newest():
        pass
    driver.run.offered.discard_button.click()
    assert path.is_file()
    driver.press(Qt.Key.Key_F3)
    driver.wait(lambda: not driver.run.offered.isVisible())
    assert not path.exists()
    assert (tmp_path / "store" / "discarded" / "SN-1" / path.stem / path.name).is_file()
    driver.wait(lambda: driver.window.records.cut_off.table.rowCount() == 0)


def test_what_is_not_agreed_to_is_not_discarded(interrupted):
    driver, path = interrupted
    driver.wait(driver.run.offered.isVisible)
    driver.run.offered.discard_button.click()
    driver.press(Qt.Key.Key_Escape)
    assert path.is_file()
    assert driver.run.offered.isVisible()


@pytest.fixture
def without_end(monkeypatch):
    """Leaves recordings as a program that was killed does."""
    record = Recorder.record

    def record_all_but_the_end(recorder, event):
        return None if isinstance(event, RunFinished) else record(recorder, event)

    monkeypatch.setattr(Recorder, "record", record_all_but_the_end)


def test_a_run_that_another_session_left_is_offered_at_the_start(without_end, interrupted):
    driver, path = interrupted
    assert read_recording(path).ending is None
    before = driver.window
    driver.running._restart()
    driver.wait(lambda: driver.window is not before)
    driver.window.open(driver.run)
    driver.wait(driver.run.offered.isVisible)
    assert driver.run.offered.text().endswith("it broke off.")
