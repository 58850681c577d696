import sys
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from window_driver import TINY

from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.messages import Message
from tumble.procedures.events import FinishReason
from tumble.procedures.recording.reader import read_recording
from tumble.window.faults import files_named, keep_details
from tumble.window.methods.dividing_head.live_fit import fit_live
from tumble.window.screens.run_state import Mood

LOST = DeviceError("voltmeter", "does not answer", "check its cable, then resume the run")


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def at_call(monkeypatch, number, error):
    """Have the DAQ fail once."""
    acquire, calls = SimulatedDaq.acquire, []

    def failing(*arguments):
        calls.append(arguments)
        if len(calls) == number:
            raise error
        return acquire(*arguments)

    monkeypatch.setattr(SimulatedDaq, "acquire", failing)


def recording(tmp_path):
    (path,) = (tmp_path / "store").glob("recordings/SN-1/*.mcap")
    return read_recording(path)


def test_a_device_fault_in_mid_run_is_told_and_the_points_are_kept(driver, tiny, tmp_path, monkeypatch):
    at_call(monkeypatch, 3 * 2 + 2, LOST)
    driver.start(tiny)
    driver.wait(lambda: driver.complaints)
    (told,) = driver.complaints
    assert told.startswith(
        "voltmeter: does not answer; check its cable, then resume the run; 2 complete points kept in"
    )
    found = recording(tmp_path)
    assert found.ending.reason is FinishReason.DEVICE_FAULT
    assert found.ending.at_standstill
    assert driver.run.controls.start.isEnabled()


def test_a_run_that_a_fault_ended_is_red_until_somebody_says_what_becomes_of_it(driver, tiny, monkeypatch):
    said = []
    at_call(monkeypatch, 3 * 2 + 2, LOST)
    driver.start(tiny)
    driver.run.state_changed.connect(lambda text, _: said.append(text))
    driver.wait(driver.run.offered.isVisible)
    assert "Ready" not in said
    assert (driver.run.course.now.text, driver.run.course.now.mood) == ("Stopped by a fault", Mood.FAULT)
    driver.run.offered.later_button.click()
    assert driver.run.course.now.mood is Mood.READY


def test_a_run_that_a_fault_ended_is_offered_and_goes_on_to_its_record(driver, tiny, tmp_path, monkeypatch, no_report):
    at_call(monkeypatch, 3 * 2 + 2, LOST)
    driver.start(tiny)
    driver.wait_for_end()
    monkeypatch.undo()
    driver.dismiss_all()
    records = driver.window.records
    driver.window.open(records)
    records.refresh()
    driver.wait(lambda: records.cut_off.table.rowCount() == 1)
    assert records.cut_off.table.texts()[0][:5] == [
        "SN-1",
        "An accelerometer on a dividing head",
        "tiny",
        "2",
        "device fault",
    ]
    records.tabs.setCurrentWidget(records.cut_off)
    driver.press(Qt.Key.Key_F7)
    presentation = driver.wait_for_result()
    assert len(driver.run.view.points) == 6
    assert presentation.concluded.record_id
    records.refresh()
    driver.wait(lambda: records.cut_off.table.rowCount() == 0 and records.table.rowCount() == 1)


def test_what_a_fault_offers_is_withdrawn_once_the_run_goes_on(driver, tiny, monkeypatch, no_report):
    at_call(monkeypatch, 3 * 2 + 2, LOST)
    driver.start(tiny)
    driver.wait(driver.run.offered.isVisible)
    assert [card.notice.action.title for card in driver.window.notices.cards] == ["Go on with it"]
    monkeypatch.undo()
    driver.press(Qt.Key.Key_F7)
    driver.wait(lambda: not driver.complaints)
    assert driver.wait_for_result().concluded.record_id


def test_what_a_fault_offers_stays_where_the_run_does_not_go_on(driver, tiny, monkeypatch):
    at_call(monkeypatch, 3 * 2 + 2, LOST)
    driver.start(tiny)
    driver.wait(driver.run.offered.isVisible)
    asked = []
    monkeypatch.setattr(driver.run, "begin", lambda *_: asked.append(True))
    driver.press(Qt.Key.Key_F7)
    driver.wait(lambda: asked)
    assert [card.notice.action.title for card in driver.window.notices.cards] == ["Go on with it"]


def test_an_exception_anywhere_becomes_a_notice_and_stops_the_run(driver, long, tmp_path):
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    driver.start(long)
    driver.wait_for_points(1)
    hook = sys.excepthook
    driver.running.catch_faults()
    try:
        sys.excepthook(ZeroDivisionError, ZeroDivisionError("division by zero"), None)
    finally:
        sys.excepthook = hook
    driver.wait_for_end()
    (card,) = driver.window.notices.cards
    assert card.notice.text == "A fault of the program; the head was told to stop."
    assert str(tmp_path / "state" / "tumble" / "window-faults.log") in card.notice.details
    assert "ZeroDivisionError" in (tmp_path / "state" / "tumble" / "window-faults.log").read_text("utf-8")
    assert recording(tmp_path).ending.reason is FinishReason.STOPPED


def test_a_fault_in_the_analysis_is_a_notice_too(driver, tiny, monkeypatch):
    monkeypatch.setattr("tumble.app.methods.dividing_head.job.explain_questioned", lambda *_: 1 / 0)
    driver.start(tiny)
    driver.wait(lambda: driver.complaints)
    assert driver.complaints == ["A fault of the program; the head was told to stop."]
    assert driver.run.controls.start.isEnabled()


def test_a_stand_file_that_is_wrong_is_told_with_its_line(driver, write):
    driver.window.stand.open(write("bad.toml", 'name = "x"\n[head]\ndriver = "simulated"\n'))
    (told,) = driver.complaints
    assert "bad.toml" in told


def test_a_programme_that_the_stand_forbids_moves_nothing(driver, write):
    driver.open_run(write("far.toml", TINY.replace("60.0", "600.0")))
    driver.run.start()
    (told,) = driver.complaints
    assert "outside the head's limits" in told
    assert not driver.window.busy


def test_a_gross_error_is_ringed_at_once(driver, write, no_report):
    driver.start(write("sweep.toml", TINY.replace("points = 6", "points = 36").replace("60.0", "10.0")))
    driver.wait_for_points(36)
    points = driver.run.view.figures.points
    spoilt = [
        *points[:20],
        type(points[20])(**{**vars(points[20]), "voltage_v": points[20].voltage_v + 0.2}),
        *points[21:],
    ]
    driver.run.view.figures.residual.draw_fit(spoilt, fit_live(spoilt))
    assert driver.run.view.figures.residual.ringed == 1


def test_details_of_a_user_without_a_home_are_kept_nowhere(monkeypatch):
    def homeless():
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr("tumble.window.faults.state_folder", homeless)
    assert keep_details(ZeroDivisionError("x")) == Path("-")


def test_a_file_that_a_fault_of_an_instrument_names_can_be_opened(write):
    path = write("my_head.py", "")
    failed = Message("its driver {driver} failed (bent)", driver=path)
    assert files_named(DeviceError("dividing head", failed, "correct it")) == [path]
