"""What a person needs who has no mouse."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton, QVBoxLayout, QWidget

from benchmarks.window_hands import Hands
from tumble.window.widgets.dialog import FileDialog
from tumble.window.widgets.key_fields import KeyFields
from tumble.window.widgets.table import Table

SAMPLES = Path(__file__).parents[2] / "docs" / "samples"


@pytest.fixture
def driver(lent_driver):
    """A window that has the keyboard."""
    lent_driver.window.activateWindow()
    lent_driver.wait(lent_driver.window.isActiveWindow)
    return lent_driver


def with_focus():
    return QApplication.focusWidget()


def test_tab_comes_out_of_a_day_that_is_none(driver):
    search = driver.window.records.search
    driver.window.open(driver.window.records)
    search.since.setFocus()
    QTest.keyClick(driver.window.windowHandle(), Qt.Key.Key_Tab)
    assert with_focus() is search.until


def test_tab_goes_from_one_field_for_a_key_to_the_next(driver):
    hands = Hands(driver.window)
    hands.press("Ctrl+,")
    first, second = list(driver.window.settings.findChild(KeyFields).fields.values())[:2]
    hands.tab_to(first)
    hands.press("Tab")
    assert with_focus() is second
    assert first.keySequence() == first.shortcut.chosen


@pytest.mark.parametrize("key", ["Ctrl+1", "Ctrl+2", "Ctrl+4", "Ctrl+,", "F1"])
def test_a_screen_that_is_opened_has_the_keyboard(driver, key):
    Hands(driver.window).press(key)
    assert driver.window.frame.current.isAncestorOf(with_focus())


def test_a_screen_remembers_where_the_keyboard_was(driver):
    search = driver.window.records.search
    hands = Hands(driver.window)
    hands.press("Ctrl+4")
    hands.tab_to(search.until)
    hands.press("Ctrl+1")
    hands.press("Ctrl+4")
    assert with_focus() is search.until


def test_a_file_that_is_asked_for_can_be_typed_at_once_and_the_keyboard_goes_back(driver):
    records = driver.window.records
    driver.window.open(records)
    records.search.serial.setFocus()
    records.file_button.click()
    (dialog,) = driver.window.dialogs.findChildren(FileDialog)
    Hands(driver.window).type("no-such.csv")
    assert [Path(each).name for each in dialog.files.selectedFiles()] == ["no-such.csv"]
    Hands(driver.window).press("Esc")
    assert with_focus() is records.search.serial


def test_after_a_programme_was_chosen_a_scan_is_heard(driver, tiny):
    driver.window.open(driver.run)
    driver.run.form._browse.click()
    hands = Hands(driver.window)
    hands.scan(str(tiny))
    assert driver.run.form.chosen == str(tiny)
    hands.scan("SN-7")
    assert driver.run.form.serial.text() == "SN-7"


def test_a_table_that_tab_reaches_has_a_row_chosen(qtbot):
    table, button = Table(("unit",)), QPushButton("before")
    window = QWidget()
    column = QVBoxLayout(window)
    column.addWidget(button)
    column.addWidget(table)
    qtbot.addWidget(window)
    table.fill([("A-1",), ("B-2",)])
    window.show()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    button.setFocus()
    assert table.chosen == []
    Hands(window).press("Tab")
    assert table.chosen == [0]
    Hands(window).press("Down")
    assert table.chosen == [1]


def test_a_question_leaves_the_keyboard_to_the_scanner(driver):
    driver.window.open(driver.run)
    driver.run.form.serial.setFocus()
    driver.window.way_out._ask()
    assert with_focus() is driver.run.form.serial


def test_a_part_that_no_tab_reaches_is_told_by_name(driver, qtbot):
    apart = QPushButton("apart")
    qtbot.addWidget(apart)
    with pytest.raises(Exception, match="no Tab reaches QPushButton “apart”, but: "):
        Hands(driver.window).tab_to(apart)
