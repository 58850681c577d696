"""What answers a question is in sight when the question comes, on a small screen with large text too."""

import pytest
from PySide6.QtCore import QPoint, QSettings
from PySide6.QtWidgets import QAbstractSlider

SMALL = (1264, 760)
"""1280 × 800 without the frame of a window manager."""


@pytest.fixture
def small(lent_driver):
    """The screen of a run, with as large a text as there is."""
    window = lent_driver.window
    before = window.size()
    window.resize(*SMALL)
    window.choices.choose_scale(2.0)
    window.open(window.run)
    yield lent_driver
    window.run.view.ask_nothing()
    window.choices.choose_scale(1.0)
    QSettings().setValue("look/text_scale", 1.0)
    window.resize(before)


def in_sight(part):
    return not part.visibleRegion().isEmpty() and part.visibleRegion().boundingRect() == part.rect()


def area(driver):
    return driver.run.parentWidget().parentWidget()


def test_the_button_for_the_next_unit_is_in_sight(small):
    small.run.view.ask_unit("SN-2")
    small.wait(lambda: in_sight(small.run.view.unit.confirm), 10)


def test_the_field_for_a_reading_is_in_sight(small):
    small.run.view.ask_reading(12.5, "Set the head to 12° 30′ 00″, and type what it reads, or only Enter if it is that")
    small.wait(lambda: in_sight(small.run.view.reading.field), 10)


def test_the_button_stays_in_sight_when_there_are_more_words(small):
    small.run.view.ask_unit("SN-2")
    small.wait(lambda: in_sight(small.run.view.unit.confirm), 10)
    small.run.view.unit.say("Take the unit off the stand, and put SN-2 in its place, with its cable to the left. " * 2)
    small.wait(lambda: small.run.view.unit.confirm.mapTo(area(small).widget(), QPoint(0, 0)).y() > SMALL[1], 10)
    small.wait(lambda: in_sight(small.run.view.unit.confirm), 10)


@pytest.fixture
def read_above(small):
    """Somebody who has gone back up to read, while a question waits."""
    small.run.view.ask_unit("SN-2")
    small.wait(lambda: in_sight(small.run.view.unit.confirm), 10)
    bar = area(small).verticalScrollBar()
    bar.triggerAction(QAbstractSlider.SliderAction.SliderToMinimum)
    assert not in_sight(small.run.view.unit.confirm)
    return small, bar


def settled(driver):
    return driver.wait(lambda: not driver.run.view.unit._laid_out.isActive(), 10)


def test_whoever_has_scrolled_by_hand_stays_there_when_the_words_change(read_above):
    small, bar = read_above
    small.run.view.unit.say("The head is at 330°, turn to 0°")
    settled(small)
    assert bar.value() == 0


def test_the_next_question_comes_with_its_answer_again(read_above):
    small, _ = read_above
    small.run.view.ask_nothing()
    small.run.view.ask_unit("SN-3")
    small.wait(lambda: in_sight(small.run.view.unit.confirm), 10)


def test_whoever_writes_above_is_left_there(small):
    bar = area(small).verticalScrollBar()
    small.window.activateWindow()
    small.wait(small.window.isActiveWindow)
    small.type("SN-7", small.run.form.serial)
    bar.setValue(0)
    small.run.view.ask_unit("SN-2")
    settled(small)
    assert bar.value() == 0
    small.run.form.serial.setText("")
