"""Signs of the screens, their keys, and the badges that are seen from every screen."""

import pytest
from PySide6.QtCore import QSize, Qt
from window_driver import STAND, TINY

from tumble.window.badges import RECORDS, RESULT, RUN
from tumble.window.badges import STAND as STAND_PLACE
from tumble.window.look.icons import icon
from tumble.window.look.tints import AMBER, BLUE, GREEN, VIOLET

PERSON = STAND.replace('driver = "simulated"\nlimits', 'driver = "manual"\nserial = "OG-7"\nlimits')


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def badge(driver, place):
    return driver.window.frame.rail.buttons[place].badge


@pytest.mark.parametrize(
    ("key", "modifiers", "screen"),
    [
        (Qt.Key.Key_1, Qt.KeyboardModifier.ControlModifier, "stand"),
        (Qt.Key.Key_2, Qt.KeyboardModifier.ControlModifier, "run"),
        (Qt.Key.Key_3, Qt.KeyboardModifier.ControlModifier, "result"),
        (Qt.Key.Key_4, Qt.KeyboardModifier.ControlModifier, "records"),
        (Qt.Key.Key_Comma, Qt.KeyboardModifier.ControlModifier, "settings"),
        (Qt.Key.Key_F1, Qt.KeyboardModifier.NoModifier, "help"),
    ],
)
def test_every_screen_has_a_key(driver, key, modifiers, screen):
    driver.press(key, modifiers)
    driver.wait(getattr(driver.window, screen).isVisible)
    assert driver.window.frame.current is getattr(driver.window, screen)


def test_a_stand_that_answers_wears_a_badge(driver):
    assert badge(driver, STAND_PLACE) is None
    driver.window.stand.connect_button.click()
    driver.wait(lambda: badge(driver, STAND_PLACE) is not None)
    assert badge(driver, STAND_PLACE).tint is GREEN
    driver.window.stand.disconnect_button.click()
    driver.wait(lambda: badge(driver, STAND_PLACE) is None)


def test_what_a_run_does_is_seen_from_every_screen(driver, long):
    driver.start(long)
    driver.wait(lambda: badge(driver, RUN) is not None and badge(driver, RUN).tint is BLUE)
    driver.press(Qt.Key.Key_F6)
    name = driver.window.frame.rail.buttons[RUN].accessibleName
    driver.wait(lambda: name() == "Run: Paused at a standstill")
    assert badge(driver, RUN).tint is VIOLET


def test_whoever_is_waited_for_is_told_by_a_badge(driver, write):
    driver.window.stand.open(write("person.toml", PERSON))
    driver.start(write("tiny.toml", TINY), imagined=False)
    driver.wait(lambda: badge(driver, RUN) is not None and badge(driver, RUN).sign == "!")
    assert badge(driver, RUN).tint is AMBER


def test_a_result_takes_nobody_away_from_another_screen(driver, tiny, no_report):
    driver.start(tiny)
    driver.window.open(driver.window.settings)
    driver.wait_for_result()
    assert driver.window.frame.current is driver.window.settings
    assert badge(driver, RESULT).meaning == "a new result"
    driver.window.open(driver.window.result)
    assert badge(driver, RESULT) is None


def test_a_result_is_shown_to_whoever_watched_its_run(driver, tiny, no_report):
    driver.start(tiny)
    driver.wait_for_result()
    assert driver.window.frame.current is driver.window.result
    assert badge(driver, RESULT) is None


def test_a_result_takes_nobody_away_from_a_run_that_was_stopped(driver, tiny, no_report):
    driver.start(tiny)
    driver.window.run.broken_off = True  # that of the next unit, while this one was analysed
    driver.wait_for_result()
    assert driver.window.frame.current is driver.window.run
    assert badge(driver, RESULT).meaning == "a new result"


def test_runs_without_a_record_are_counted(driver, long):
    driver.start(long)
    driver.wait_for_points(1)
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    driver.wait(lambda: badge(driver, RECORDS) is not None)
    assert (badge(driver, RECORDS).sign, badge(driver, RECORDS).meaning) == ("1", "1 without a record")


def test_titles_are_left_out_where_the_window_is_narrow_for_its_text(driver):
    rail, shown = driver.window.frame.rail, {}
    for lines in (40, 60):
        driver.window.resize(lines * rail.fontMetrics().height(), 760)
        driver.wait(lambda lines=lines: driver.window.width() == lines * rail.fontMetrics().height())
        shown[lines] = rail.buttons[0].toolButtonStyle()
    assert list(shown.values()) == [Qt.ToolButtonStyle.ToolButtonIconOnly, Qt.ToolButtonStyle.ToolButtonTextUnderIcon]


@pytest.mark.parametrize("name", ["stand", "run", "result", "records", "settings", "help"])
def test_a_sign_is_painted_in_the_inks_that_it_is_given(qapp, name):
    image = icon(name, "#FF0000", "#0000FF").pixmap(QSize(48, 48)).toImage()
    seen = {
        image.pixelColor(x, y).name() for x in range(48) for y in range(48) if image.pixelColor(x, y).alpha() == 255
    }
    assert seen == {"#ff0000"}
