"""Whatever the window can do is found by a part of its name, by keyboard alone; a scanner starts nothing by it."""

from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QSettings, Qt
from PySide6.QtWidgets import QApplication, QPushButton
from window_driver import STAND

from tumble.window.finder.fuzzy import score
from tumble.window.recent import recent_stands
from tumble.window.screens.run_state import Phase


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    yield lent_driver
    QSettings().remove("stand/recent")


def find(driver, typed=""):
    driver.press(Qt.Key.Key_K, Qt.KeyboardModifier.ControlModifier)
    driver.wait(driver.window.finder.isVisible)
    driver.bot.keyClicks(driver.window.finder.field, typed)
    return driver.window.finder


def press(driver, key):
    driver.press(key, at=driver.window.finder.field)


@pytest.mark.parametrize(
    ("typed", "name"),
    [
        ("", "Run: Start"),
        ("rst", "Run: Start"),
        ("START", "Run: Start"),
        ("run st", "Run: Start"),
        ("почати", "Почати"),
    ],
)
def test_letters_in_their_order_are_found(typed, name):
    assert score(typed, name) is not None


@pytest.mark.parametrize(("typed", "name"), [("x", "Run: Start"), ("trats", "Run: Start"), ("startt", "Run: Start")])
def test_other_letters_are_not(typed, name):
    assert score(typed, name) is None


@pytest.mark.parametrize(
    ("typed", "better", "worse"),
    [
        ("st", "Run: Start", "Run: Last one"),
        ("pause", "Run: Pause", "Paper use"),
        ("dark", "View: Dark", "Do all rank"),
    ],
)
def test_beginnings_and_letters_in_a_row_come_first(typed, better, worse):
    assert score(typed, better) > score(typed, worse)


def test_a_screen_is_opened_by_a_part_of_its_name(driver):
    find(driver, "recor")
    press(driver, Qt.Key.Key_Return)
    assert driver.window.frame.current is driver.window.records
    assert not driver.window.finder.isVisible()


def test_esc_goes_back_to_where_one_was(driver):
    driver.window.open(driver.run)
    driver.run.form.serial.setFocus()
    finder = find(driver, "x")
    press(driver, Qt.Key.Key_Escape)
    assert not finder.isVisible()
    driver.wait(driver.run.form.serial.hasFocus)


def test_the_arrows_choose(driver):
    finder = find(driver)
    first, second = finder.titles[:2]
    press(driver, Qt.Key.Key_Down)
    assert finder.chosen.name == second
    press(driver, Qt.Key.Key_Up)
    press(driver, Qt.Key.Key_Up)
    assert finder.chosen.name == first


def test_every_button_that_can_be_pressed_now_is_found(driver):
    driver.run.form.serial.setText("SN-1")
    found = find(driver).titles
    assert {"Run: Start", "Stand: Connect", "Help: Contents", "View: High contrast", "Records: Trend"} <= set(found)
    assert "Run: Pause" not in found
    assert len(found) == len(set(found))


def test_enter_presses_a_button(driver):
    find(driver, "stand connect")
    assert driver.window.finder.chosen.name == "Stand: Connect"
    press(driver, Qt.Key.Key_Return)
    driver.wait(lambda: driver.window.worker.session.is_connected)


def test_what_a_scanner_types_starts_no_run(driver, long):
    driver.open_run(long)
    find(driver, "run: start")
    assert driver.window.finder.chosen.name == "Run: Start"
    press(driver, Qt.Key.Key_Return)
    driver.bot.wait(50)
    assert driver.run.phase is Phase.IDLE
    assert driver.window.finder.isVisible()
    assert "F3" in driver.window.finder.said.text()


def test_f3_starts_it(driver, long):
    driver.open_run(long)
    find(driver, "run: start")
    press(driver, Qt.Key.Key_F3)
    driver.wait(lambda: driver.run.phase is Phase.RUNNING)


def test_f3_in_the_finder_answers_no_question(driver):
    driver.window.way_out._ask()
    find(driver, "settings")
    press(driver, Qt.Key.Key_F3)
    assert driver.window.isVisible()
    assert driver.window.frame.current is driver.window.settings
    assert len(driver.window.dialogs.open) == 1


def test_stop_is_found_too(driver, long):
    driver.start(long)
    find(driver, "stop the head")
    press(driver, Qt.Key.Key_Return)
    driver.wait_for_end()


def test_a_stand_that_was_chosen_lately_is_chosen_again(driver, write):
    first, second = write("a.toml", STAND.replace("bench-1", "A")), write("b.toml", STAND.replace("bench-1", "B"))
    for path in (first, second):
        driver.window.stand.open(path)
    find(driver, "a.toml")
    press(driver, Qt.Key.Key_Return)
    assert driver.window.stand.loaded.file.name == "A"
    assert [Path(path) for path in recent_stands()] == [first, second]


def test_stands_that_are_gone_are_not_offered(driver, write):
    path = write("gone.toml", STAND)
    driver.window.stand.open(path)
    path.unlink()
    assert str(path) not in recent_stands()


def test_a_unit_of_the_store_is_found(driver, tiny, no_report):
    driver.start(tiny, serial="QX-77")
    driver.wait_for_result()
    finder = find(driver, "qx77")
    driver.wait(lambda: finder.titles == ["Unit under test: QX-77"])
    press(driver, Qt.Key.Key_Return)
    assert driver.window.frame.current is driver.window.records
    assert driver.window.records.search.serial.text() == "QX-77"
    driver.window.records.search.serial.clear()


def test_nothing_is_said_to_be_nothing(driver):
    finder = find(driver, "qqqqqq")
    assert (finder.titles, finder.said.text()) == ([], "Nothing is called like that.")
    press(driver, Qt.Key.Key_Return)
    assert finder.isVisible()


def test_the_menus_are_found_after_parts_of_a_screen_were_taken_away(driver):
    window = driver.window
    passing = QPushButton(window.result)
    window.result.setEnabled(False)  # the keyboard finds nothing there, however far it looks
    window.open(window.result)
    window.result.setEnabled(True)
    window.open(window.stand)
    passing.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    window.finding.begin()
    window.menus.show_choices()
    assert window.frame.finder.isVisible()
