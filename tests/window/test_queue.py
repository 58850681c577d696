"""The queue of the screen Run: from what is added to the verdicts, with what holds it."""

import json
from threading import Event

import pytest
from PySide6.QtCore import Qt
from window_driver import STAND, TINY

from tumble.app import calibrating
from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.window.look.tints import AMBER
from tumble.window.work.run_queue import Stage


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def add(driver, programme, *serials, imagined=True):
    """Scan units and add each with the key."""
    driver.window.stand.simulation.imagined.setChecked(imagined)
    driver.window.open(driver.run)
    driver.run.form.add_programme(str(programme))
    for serial in serials:
        driver.run.form.await_scan()
        driver.scan(serial)
        before = len(entries(driver))
        driver.press(Qt.Key.Key_F2)
        driver.wait(lambda before=before: len(entries(driver)) > before or driver.complaints, 10)


def entries(driver):
    return driver.run.queue.queue.entries


def stages(driver):
    return [(entry.serial_number, entry.stage) for entry in entries(driver)]


def states(driver):
    return [row[-1] for row in driver.run.queue_view.table.texts()]


def wait_for(driver, *stages_wanted):
    driver.wait(lambda: [stage for _, stage in stages(driver)] == list(stages_wanted), 20)


def test_units_are_measured_one_after_the_other_to_their_records(driver, tiny, no_report):
    add(driver, tiny, "A-1", "B-2")
    assert states(driver) == ["○ waiting", "○ waiting"]
    assert not driver.window.busy
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.JUDGED, Stage.JUDGED)
    assert states(driver) == ["not judged", "not judged"]
    assert driver.run.queue_view.said.text() == "Everything in the queue was measured."
    driver.wait(lambda: len(driver.window.records.records) == 2)
    assert {record.id for record in driver.window.records.records} == {entry.record_id for entry in entries(driver)}


def test_a_unit_that_is_scanned_right_after_the_key_is_not_the_one_that_is_added(driver, tiny):
    driver.window.open(driver.run)
    driver.run.form.add_programme(str(tiny))
    for serial in ("A-1", "B-2", "C-3"):
        driver.run.form.await_scan()
        driver.scan(serial)
        driver.press(Qt.Key.Key_F2)
    assert [entry.serial_number for entry in entries(driver)] == ["A-1", "B-2", "C-3"]


def test_the_lot_of_a_unit_goes_from_the_form_to_its_record(driver, tiny, no_report):
    driver.run.form.lot.setText(" L-26 ")
    add(driver, tiny, "A-1")
    driver.run.form.lot.setText("L-27")
    add(driver, tiny, "B-2")
    driver.run.form.lot.clear()
    assert [row[1] for row in driver.run.queue_view.table.texts()] == ["L-26", "L-27"]
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.JUDGED, Stage.JUDGED)
    driver.wait(lambda: len(driver.window.records.records) == 2)
    lots = {each.provenance.serial_number: each.provenance.lot for each in driver.window.records.records}
    assert lots == {"A-1": "L-26", "B-2": "L-27"}


def test_repeats_are_runs_of_their_own(driver, tiny):
    driver.window.open(driver.run)
    driver.run.controls.repeats.setValue(3)
    add(driver, tiny, "A-1")
    assert [row[3] for row in driver.run.queue_view.table.texts()] == ["1 / 3", "2 / 3", "3 / 3"]
    assert driver.run.controls.repeats.value() == 1


def test_the_queue_is_worked_by_keys_alone(driver, tiny):
    add(driver, tiny, "A-1", "B-2", "C-3")
    table = driver.run.queue_view.table
    table.setFocus()
    table.selectRow(2)
    driver.press(Qt.Key.Key_Up, Qt.KeyboardModifier.AltModifier, at=table)
    driver.press(Qt.Key.Key_Up, Qt.KeyboardModifier.AltModifier, at=table)
    assert [serial for serial, _ in stages(driver)] == ["C-3", "A-1", "B-2"]
    driver.press(Qt.Key.Key_Down, Qt.KeyboardModifier.AltModifier, at=table)
    assert [serial for serial, _ in stages(driver)] == ["A-1", "C-3", "B-2"]
    driver.press(Qt.Key.Key_Delete, at=table)
    assert [serial for serial, _ in stages(driver)] == ["A-1", "B-2"]
    driver.run.queue_view.clear_button.click()
    assert stages(driver) == []


def test_the_record_of_a_line_is_opened_by_enter(driver, tiny, no_report):
    add(driver, tiny, "A-1")
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.JUDGED)
    driver.wait(lambda: driver.window.result.presentation is not None)
    driver.window.result.presentation = None
    driver.window.open(driver.run)
    table = driver.run.queue_view.table
    table.setCurrentCell(0, 0)
    driver.press(Qt.Key.Key_Return, at=table)
    presentation = driver.wait_for_result()
    assert presentation.concluded.record_id == entries(driver)[0].record_id


def test_the_next_unit_is_seated_while_the_last_one_is_analysed(driver, tiny, monkeypatch, no_report):
    go_on, conclude = Event(), calibrating.conclude
    monkeypatch.setattr(calibrating, "conclude", lambda *given: (go_on.wait(60), conclude(*given))[1])
    add(driver, tiny, "A-1", "B-2", imagined=False)
    driver.press(Qt.Key.Key_F4)
    driver.wait(lambda: driver.run.view.asks)
    assert stages(driver) == [("A-1", Stage.MOUNTING), ("B-2", Stage.WAITING)]
    driver.press(Qt.Key.Key_F9)
    wait_for(driver, Stage.ANALYSING, Stage.MOUNTING)
    assert driver.run.view.prompt.unit.text == "B-2"
    assert driver.window.stop_bar.state.text() == "Waits for you"
    go_on.set()
    wait_for(driver, Stage.JUDGED, Stage.MOUNTING)
    assert driver.run.isVisible()
    driver.press(Qt.Key.Key_F9)
    wait_for(driver, Stage.JUDGED, Stage.JUDGED)
    driver.wait(driver.window.result.isVisible, 10)


def test_stop_holds_the_queue_and_says_so(driver, long):
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    add(driver, long, "A-1", "B-2")
    driver.press(Qt.Key.Key_F4)
    driver.wait_for_points(1)
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    assert stages(driver) == [("A-1", Stage.STOPPED), ("B-2", Stage.WAITING)]
    said = "The queue is held: A-1 was stopped. F4 goes on with the next."
    assert driver.run.queue_view.said.text() == said
    assert driver.run.controls.start_queue.isVisible()


def test_stop_while_the_first_one_connects_holds_the_queue(driver, tiny, reaching):
    add(driver, tiny, "A-1", "B-2")
    driver.press(Qt.Key.Key_F4)
    driver.wait(reaching.is_set)
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    assert stages(driver) == [("A-1", Stage.STOPPED), ("B-2", Stage.WAITING)]
    assert driver.run.queue_view.said.text() == "The queue is held: A-1 was stopped. F4 goes on with the next."
    assert driver.complaints == []


def test_a_stopped_line_goes_on_where_the_run_does(driver, tiny, tmp_path, monkeypatch, no_report):
    at_call(monkeypatch, 8)
    add(driver, tiny, "A-1")
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.FAILED)
    driver.wait(driver.run.offered.isVisible)
    monkeypatch.undo()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    while driver.window.dialogs.close_newest():
        pass
    driver.press(Qt.Key.Key_F7)
    wait_for(driver, Stage.JUDGED)


def at_call(monkeypatch, number):
    """Have the DAQ fail once."""
    acquire, calls = SimulatedDaq.acquire, []

    def failing(*arguments):
        calls.append(arguments)
        if len(calls) == number:
            raise DeviceError("voltmeter", "does not answer", "check its cable, then resume the run")
        return acquire(*arguments)

    monkeypatch.setattr(SimulatedDaq, "acquire", failing)


def test_a_fault_holds_the_queue_and_is_told_in_its_line(driver, tiny, monkeypatch):
    at_call(monkeypatch, 8)
    add(driver, tiny, "A-1", "B-2")
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.FAILED, Stage.WAITING)
    driver.wait_for_end()
    assert states(driver)[0].startswith("✗ failed: voltmeter: does not answer")
    said = "The queue is held: A-1 failed, as its line says. F4 goes on with the next."
    assert driver.run.queue_view.said.text() == said
    assert stages(driver)[1] == ("B-2", Stage.WAITING)


def test_a_stop_is_of_the_past_once_the_run_goes_on(driver, long):
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    add(driver, long, "A-1", "B-2")
    driver.press(Qt.Key.Key_F4)
    driver.wait_for_points(1)
    driver.window.worker.stop()
    wait_for(driver, Stage.STOPPED, Stage.WAITING)
    driver.wait(lambda: driver.run.offered.isVisible() and driver.run.offered.button.isEnabled())
    driver.press(Qt.Key.Key_F7)
    wait_for(driver, Stage.MEASURING, Stage.WAITING)
    assert driver.run.queue_view.said.text() == "The queue is held; F4 goes on with it."


def test_a_unit_that_is_scanned_twice_is_told(driver, tiny):
    add(driver, tiny, "A-1", "B-2", "A-1")
    told = "A-1 waits more than once, and is measured as often; Del takes a line out."
    assert driver.run.queue_view.said.text() == told
    driver.run.queue.remove(entries(driver)[2].id)
    assert driver.run.queue_view.said.text() == ""


def test_a_unit_that_is_wanted_several_times_is_not_told(driver, tiny):
    driver.window.open(driver.run)
    driver.run.controls.repeats.setValue(3)
    add(driver, tiny, "A-1")
    assert len(entries(driver)) == 3
    assert driver.run.queue_view.said.text() == ""


def test_units_are_added_while_one_is_measured(driver, long):
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    driver.start(long, "A-1")
    driver.wait_for_points(1)
    assert not driver.run.form.isVisible()
    driver.press(Qt.Key.Key_F2)
    driver.wait(driver.run.form.isVisible, 10)
    driver.scan("B-2")
    assert driver.window.strip.names.text().endswith("A-1")
    driver.press(Qt.Key.Key_F2)
    driver.wait(lambda: stages(driver) == [("B-2", Stage.WAITING)], 10)


def test_the_queue_outlives_the_window_and_goes_on_only_when_told(driver, tiny):
    add(driver, tiny, "A-1", "B-2")
    before = driver.window
    driver.running._restart()
    driver.wait(lambda: driver.window is not before)
    assert stages(driver) == [("A-1", Stage.WAITING), ("B-2", Stage.WAITING)]
    assert not driver.run.queue.going


def test_a_damaged_queue_is_told_in_one_sentence_and_kept(driver, tmp_path):
    path = tmp_path / "store" / "queue.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text('{"schema": "tumble.queue/1", "entr', encoding="utf-8")
    driver.run.queue.open()
    assert driver.complaints == [f"{path}: is no queue that can be read; it is kept as queue.damaged-1.json"]
    assert (path.parent / "queue.damaged-1.json").read_text("utf-8") == '{"schema": "tumble.queue/1", "entr'
    assert stages(driver) == []


def test_a_run_of_another_stand_is_not_measured_here(driver, tiny, write):
    add(driver, tiny, "A-1")
    driver.window.stand.open(write("bench.toml", STAND))
    driver.window.open(driver.run)
    driver.press(Qt.Key.Key_F4)
    said = "The queue is held: what waits was added for another stand. Choose that one, then F4."
    driver.wait(lambda: driver.run.queue_view.said.text() == said)
    assert stages(driver) == [("A-1", Stage.WAITING)]
    assert not driver.window.busy


def test_a_programme_that_is_gone_fails_in_its_line_and_nothing_moves(driver, tiny):
    add(driver, tiny, "A-1")
    tiny.unlink()
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.FAILED)
    assert "there is no such file" in states(driver)[0]
    assert not driver.window.busy


def test_what_the_stand_forbids_is_not_added(driver, write):
    add(driver, write("far.toml", TINY.replace("60.0", "600.0")), "A-1")
    assert stages(driver) == []
    assert "outside the head's limits" in driver.complaints[0]


def test_the_file_says_which_version_it_is(driver, tiny, tmp_path):
    add(driver, tiny, "A-1")
    kept = json.loads((tmp_path / "store" / "queue.json").read_text("utf-8"))
    assert kept["schema"] == "tumble.queue/2"
    (entry,) = kept["entries"]
    assert entry.pop("id") == entries(driver)[0].id
    once = {"repeat": 1, "repeats": 1, "stage": "waiting"}
    assert entry == {"serial_number": "A-1", "programme": str(tiny)} | once


@pytest.fixture
def asking_nothing(monkeypatch):
    """Programmes that ask for nothing before their first dwell."""
    monkeypatch.setattr("tumble.window.screens.queue_runner.asks_first", lambda _plan: False)


def test_another_unit_is_asked_for_where_its_programme_does_not(asking_nothing, driver, tiny, no_report):
    driver.run.form.lot.setText("L 27")
    add(driver, tiny, "A-1", "B-2")
    driver.press(Qt.Key.Key_F4)
    driver.wait(driver.run.view.unit.isVisible)
    assert stages(driver)[1] == ("B-2", Stage.MOUNTING)
    assert "put B-2 · lot L 27 in its place" in driver.run.view.unit.words.text
    assert driver.window.strip.state.tint is AMBER
    driver.press(Qt.Key.Key_F9)
    wait_for(driver, Stage.JUDGED, Stage.JUDGED)
    assert not driver.run.view.unit.isVisible()


def test_a_result_hides_no_unit_that_is_asked_for(asking_nothing, driver, tiny, no_report):
    add(driver, tiny, "A-1", "B-2")
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.JUDGED, Stage.MOUNTING)
    driver.wait(lambda: driver.window.result.presentation is not None)
    assert driver.run.view.unit.isVisible()


def test_a_repeat_of_a_unit_asks_for_none(asking_nothing, driver, tiny, no_report):
    driver.window.open(driver.run)
    driver.run.controls.repeats.setValue(2)
    add(driver, tiny, "A-1")
    driver.press(Qt.Key.Key_F4)
    wait_for(driver, Stage.JUDGED, Stage.JUDGED)


def test_stop_while_another_unit_is_awaited_holds_the_queue(asking_nothing, driver, tiny, no_report):
    add(driver, tiny, "A-1", "B-2")
    driver.press(Qt.Key.Key_F4)
    driver.wait(driver.run.view.unit.isVisible)
    driver.press(Qt.Key.Key_F12)
    driver.wait(lambda: stages(driver)[1] == ("B-2", Stage.WAITING), 10)
    assert not driver.run.view.unit.isVisible()
    assert driver.run.queue_view.said.text() == "The queue is held: it was stopped. F4 goes on with it."
