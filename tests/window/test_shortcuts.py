"""Keys can be changed; those that cannot be are refused in one sentence."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence

from tumble.messages import Language
from tumble.window.look.keys import chosen_key, forget_keys
from tumble.window.look.language import speak
from tumble.window.screens.run_state import Phase
from tumble.window.shortcuts import Shortcut, refusal, shortcuts


@pytest.fixture
def driver(lent_driver):
    """A window that was lent, with the keys that it usually has."""
    yield lent_driver
    forget_keys()
    lent_driver.window.settings.keys.changed.emit()


@pytest.fixture(autouse=True)
def english(qapp):
    speak(Language.ENGLISH)


PAUSE = Shortcut(usual="F6", title="Pause", moves=True)
FIND = Shortcut(usual="Ctrl+K", title="Find a command…", moves=False)


@pytest.mark.parametrize(
    ("key", "shortcut", "words"),
    [
        ("F12", PAUSE, "stops the head"),
        ("Ctrl+.", FIND, "stops the head"),
        ("Ctrl+K", PAUSE, "is the key of “Find a command…”"),
        ("F6", FIND, "is the key of “Pause”"),
        ("F3", FIND, "fields, plots and questions"),
        ("Esc", FIND, "fields, plots and questions"),
        ("Ctrl+C", FIND, "fields, plots and questions"),
        ("Ctrl+M", PAUSE, "barcode scanner"),
        ("P", PAUSE, "barcode scanner"),
        ("P", FIND, "typed in fields"),
        ("Alt+P", FIND, "typed in fields"),
        ("Left", FIND, "typed in fields"),
    ],
)
def test_a_key_that_cannot_be_is_refused_in_one_sentence(settings, key, shortcut, words):
    said = refusal(QKeySequence(key), shortcut, (PAUSE, FIND))
    assert words in said
    assert said.count(".") - key.count(".") * said.count(key) == 1


@pytest.mark.parametrize(
    ("key", "shortcut"), [("F10", PAUSE), ("Ctrl+PgDown", PAUSE), ("Shift+F6", PAUSE), ("Ctrl+J", FIND), ("F6", PAUSE)]
)
def test_other_keys_are_taken(settings, key, shortcut):
    assert refusal(QKeySequence(key), shortcut, (PAUSE, FIND)) == ""


def field(driver, usual):
    driver.window.open(driver.window.settings)
    driver.wait(lambda: driver.window.settings.keys.fields)
    return driver.window.settings.keys.fields[usual]


def test_the_window_lists_its_own_keys(driver):
    listed = {each.usual: each for each in shortcuts(driver.window)}
    assert {"Ctrl+1", "Ctrl+,", "F1", "Ctrl+K", "F4", "F5", "F6", "F7", "F8", "F9", "Ctrl+Left"} <= set(listed)
    assert listed["F5"].moves
    assert not listed["Ctrl+1"].moves


def test_a_key_that_is_changed_works_at_once_and_the_former_no_more(driver, long):
    driver.bot.keyClick(field(driver, "F6"), Qt.Key.Key_F10)
    assert driver.run.controls.pause.text() == "Pause  [F10]"
    driver.start(long)
    driver.wait_for_points(1)
    driver.press(Qt.Key.Key_F6)
    assert not driver.run.course.now.pausing
    driver.press(Qt.Key.Key_F10)
    driver.wait(lambda: driver.run.course.now.paused or driver.run.course.now.pausing)
    assert driver.run.phase is Phase.RUNNING


def test_a_key_that_is_refused_leaves_the_one_before(driver):
    wanted = field(driver, "F6")
    driver.bot.keyClick(wanted, Qt.Key.Key_F5)
    assert wanted.keySequence() == QKeySequence("F6")
    assert "is the key of" in driver.window.settings.keys.said.text()
    assert driver.run.controls.pause.text() == "Pause  [F6]"


def test_a_key_is_kept_for_the_next_window(driver):
    driver.bot.keyClick(field(driver, "Ctrl+K"), Qt.Key.Key_J, Qt.KeyboardModifier.ControlModifier)
    before = driver.window
    driver.running._restart()
    driver.wait(lambda: driver.window is not before)
    driver.press(Qt.Key.Key_J, Qt.KeyboardModifier.ControlModifier)
    driver.wait(driver.window.finder.isVisible)


def test_all_come_back_as_usual(driver):
    driver.bot.keyClick(field(driver, "F6"), Qt.Key.Key_F10)
    driver.window.settings.keys.usual_button.click()
    assert chosen_key("F6") == QKeySequence("F6")
    assert driver.run.controls.pause.text() == "Pause  [F6]"
    assert field(driver, "F6").keySequence() == QKeySequence("F6")
