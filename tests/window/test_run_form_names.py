"""Unit, lot and operator as they are typed, pasted and scanned into the form of the screen Run."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication
from records_examples import calibration, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.store import Store
from tumble.procedures.errors import InputError
from tumble.window.screens.result import notices_of
from tumble.window.work.activity import Calibration


@pytest.fixture
def driver(lent_driver):
    """A window that shows the form."""
    for field in (lent_driver.run.form.lot, lent_driver.run.form.operator):
        field.clear()
    lent_driver.open_run("quick", serial="A-1")
    return lent_driver


def test_after_a_lot_was_scanned_the_scanner_is_at_the_serial_number(driver):
    form = driver.run.form
    form.lot.setFocus()
    driver.scan("L 26/3", at=form.lot)
    assert QApplication.focusWidget() is form.serial
    assert form.serial.selectedText() == "A-1"


@pytest.mark.parametrize("field", ["serial", "lot"])
def test_what_is_scanned_after_a_click_takes_the_place_of_what_was_there(driver, field):
    box = getattr(driver.run.form, field)
    box.setText("L 26/2")
    driver.run.form.operator.setFocus()
    driver.bot.mouseClick(box, Qt.MouseButton.LeftButton)
    driver.wait(lambda: box.selectedText() == "L 26/2", 2)
    driver.scan("L 26/3", at=box)
    assert box.text() == "L 26/3"


@pytest.mark.parametrize("field", ["serial", "lot", "operator"])
def test_what_cannot_be_seen_in_a_name_that_was_pasted_is_refused(driver, field):
    QApplication.clipboard().setText("A-1\r\nA-2")
    box = getattr(driver.run.form, field)
    box.clear()
    box.paste()
    with pytest.raises(InputError, match=r"\\x0d at character 4 cannot be seen"):
        driver.run.form.job()


@pytest.mark.parametrize("field", ["serial", "lot", "operator"])
def test_a_name_that_is_too_long_is_refused_and_not_cut(driver, field):
    box = getattr(driver.run.form, field)
    box.clear()
    driver.scan("A" * 101, at=box)
    with pytest.raises(InputError, match="101 characters are no name; give 100 at most"):
        driver.run.form.job()


def test_blanks_round_a_name_are_none_of_it(driver):
    driver.run.form.lot.setText("  L 26/3 ")
    assert driver.run.form.job().lot == "L 26/3"


def test_another_run_leaves_what_was_typed_for_the_next_one(driver, tiny, tmp_path, no_report):
    form = driver.run.form
    form.add_programme(str(tiny))
    other = replace(form.job(), serial_number="B-2", lot="L 26/2")
    form.lot.setText("L 26/3")
    assert driver.run.begin(Calibration(job=other, store=tmp_path / "store"))
    driver.wait_for_result()
    assert (form.serial.text(), form.lot.text()) == ("A-1", "L 26/3")


def test_a_mount_is_asked_for_by_unit_and_lot(driver):
    driver.run.view.begin(replace(driver.run.form.job(), lot="L 26/3"), driver.run.form.job().plan())
    assert driver.run.view.prompt.unit.text == "A-1 · lot L 26/3"


def test_a_result_says_that_its_unit_was_of_another_lot_before(driver, tiny, tmp_path, no_report):
    stand = {"head": {"driver": "simulated"}}
    origin = provenance(serial_number="A-1", lot="L 1", stand=stand, measured_at="2020-01-01T10:00:00Z")
    before = Store(tmp_path / "store").add(entry(calibration()), origin)
    driver.run.form.lot.setText("L 2")
    driver.run.form.add_programme(str(tiny))
    driver.run.start()
    said = f"A-1 is of lot L 2 here, but of lot L 1 in record {before.id}; see which is right"
    assert said in notices_of(driver.wait_for_result())
