"""State and verdict are read from two metres: large, in a colour that says what it means, growing with the text."""

import pytest
from PySide6.QtCore import QSettings, Qt
from PySide6.QtGui import QColor, QFontMetrics
from window_driver import STAND, TINY

from tumble.calibrations.core.verdict import Outcome
from tumble.window.look import tints
from tumble.window.look.theme import POINT_SIZE
from tumble.window.look.tints import AMBER, BLUE, GREEN, GREY, RED, VIOLET
from tumble.window.screens.result import _banner
from tumble.window.screens.run_state import Mood
from tumble.window.widgets.banner import LEAST_PT, Banner
from tumble.window.widgets.table import Table

PERSON = STAND.replace('driver = "simulated"\nlimits', 'driver = "manual"\nserial = "OG-7"\nlimits')


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def strip(driver):
    return driver.window.strip


def test_the_strip_names_stand_unit_and_operator(driver, write):
    driver.window.stand.open(write("bench.toml", STAND))
    driver.run.form.serial.setText("SN-9")
    driver.run.form.operator.setText("Ann")
    assert strip(driver).names.text() == "bench-1 · SN-9 · Ann"
    driver.run.form.operator.clear()


def test_the_title_names_stand_and_store(driver, write):
    driver.window.stand.open(write("bench.toml", STAND))
    assert driver.window.windowTitle() == "bench-1 – store – tumble"


def test_ready_is_grey_measuring_blue_and_paused_violet(driver, long):
    assert (strip(driver).state.text, strip(driver).state.tint) == ("Ready", GREY)
    driver.start(long)
    driver.wait(lambda: strip(driver).state.tint is BLUE)
    driver.press(Qt.Key.Key_F6)
    driver.wait(lambda: strip(driver).state.text == "Paused at a standstill")
    assert strip(driver).state.tint is VIOLET


def test_what_waits_for_the_person_is_amber(driver, write):
    driver.window.stand.open(write("person.toml", PERSON))
    driver.start(write("tiny.toml", TINY), imagined=False)
    driver.wait(lambda: driver.run.view.asks)
    assert (strip(driver).state.text, strip(driver).state.tint) == ("Waits for you", AMBER)


def test_a_stand_that_carries_out_an_order_is_not_ready(driver, reaching):
    driver.window.stand.connect_button.click()
    driver.wait(reaching.is_set)
    driver.wait(lambda: driver.window.strip.state.text == "At work")
    assert driver.window.strip.state.tint is BLUE
    driver.window.worker.stop()
    driver.wait(lambda: driver.window.strip.state.text == "Ready")


def test_an_order_that_is_told_to_stop_is_said_to_stop(driver, reaching):
    driver.window.stand.connect_button.click()
    driver.wait(reaching.is_set)
    driver.window.worker.stop()
    assert strip(driver).state.text == "Stopping"
    driver.wait(lambda: strip(driver).state.text == "Ready")
    driver.window.stand.connect_button.click()
    assert strip(driver).state.text == "At work"
    driver.window.worker.stop()
    driver.wait(lambda: strip(driver).state.text == "Ready")


def test_a_fault_is_red(driver):
    driver.run.course.see_unrest()
    assert strip(driver).state.tint is RED
    driver.run.course.see_rest()
    assert strip(driver).state.tint is GREY


def test_every_mood_has_a_colour(driver):
    for mood in Mood:
        strip(driver).show_state("…", mood)
    strip(driver).show_state("Ready", Mood.READY)


@pytest.mark.parametrize(
    ("outcome", "words", "tint"),
    [
        (Outcome.PASS, "✓ PASS", GREEN),
        (Outcome.FAIL, "✗ FAIL", RED),
        (Outcome.NOT_DECIDED, "? NOT DECIDED", AMBER),
        (Outcome.NO_LIMITS, "NO LIMITS", GREY),
    ],
)
def test_a_verdict_has_its_words_and_its_colour(qapp, settings, outcome, words, tint):
    assert _banner(outcome) == (words, tint)


def test_the_verdict_is_over_the_full_width(driver, tiny, no_report):
    driver.start(tiny)
    driver.wait_for_result()
    banner, result = driver.window.result.banner, driver.window.result
    driver.wait(banner.isVisible)
    assert banner.text == "NO LIMITS"
    assert banner.width() > 0.9 * result.width()
    assert banner.point_size(banner.width()) >= LEAST_PT


def test_state_verdict_and_stop_grow_with_the_text_at_once_in_a_run(driver, long):
    driver.start(long)
    window = driver.window
    parts = (strip(driver).state, window.result.banner)
    before = [part.point_size(4000) for part in parts], window.stop_bar.button.sizeHint().height()
    try:
        QSettings().setValue("look/text_scale", 2.0)
        window.dress_wanted.emit()
        assert [part.point_size(4000) for part in parts] == pytest.approx([2 * size for size in before[0]])
        assert window.stop_bar.button.sizeHint().height() > 1.5 * before[1]
    finally:
        QSettings().setValue("look/text_scale", 1.0)
        window.dress_wanted.emit()


def test_lines_of_a_table_stay_in_sight_with_large_text(qtbot, qapp):
    table = Table(("unit", "verdict"))
    qtbot.addWidget(table)
    before, font = table.minimumHeight(), table.font()
    font.setPointSizeF(2 * font.pointSizeF())
    table.setFont(font)
    assert table.minimumHeight() > 1.8 * before


def test_letters_are_never_smaller_than_can_be_read(driver):
    state = strip(driver).state
    state.say("Fault: the standstill was not read back", RED)
    assert state.point_size(600) == LEAST_PT
    assert state.heightForWidth(600) > state.heightForWidth(4000)


@pytest.mark.parametrize("name", ["GREY", "BLUE", "AMBER", "VIOLET", "RED", "GREEN"])
def test_letters_stand_out_from_their_ground(name):
    tint = getattr(tints, name)
    light, dark = sorted((luminance(tint.ground), luminance(tint.ink)), reverse=True)
    assert (light + 0.05) / (dark + 0.05) >= 4.5


def luminance(colour):
    """WCAG 2.1, relative luminance."""
    parts = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in QColor(colour).getRgbF()]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


@pytest.mark.parametrize("width", range(640, 960, 16))
def test_words_that_were_made_smaller_to_stay_on_a_line_stay_there(qtbot, qapp, width):
    banner = Banner()
    qtbot.addWidget(banner)
    font = banner.font()
    font.setPointSizeF(2 * POINT_SIZE)
    banner.setFont(font)
    banner.say("Готово до роботи", GREY)
    size_pt = banner.point_size(width)
    one_line = QFontMetrics(banner._sized(size_pt)).height()
    assert size_pt > LEAST_PT
    assert banner.heightForWidth(width) < 1.5 * one_line
