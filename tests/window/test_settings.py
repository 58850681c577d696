"""What is chosen on the screen Settings holds at once, and the next time."""

import pytest
from PySide6.QtCore import QSettings
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QApplication

from tumble.messages import Language
from tumble.window import preferences
from tumble.window.look.shades import CONTRAST, DARK, LIGHT, Shade
from tumble.window.look.theme import POINT_SIZE


@pytest.fixture
def driver(lent_driver):
    """A window that was lent, and looks as usual afterwards."""
    yield lent_driver
    choices = lent_driver.window.choices
    choices.choose_shade(Shade.LIGHT)
    choices.choose_scale(1.0)


@pytest.fixture
def screen(driver):
    driver.window.open(driver.window.settings)
    return driver.window.settings


def choose(box, data):
    box.setCurrentIndex(box.findData(data))
    box.activated.emit(box.currentIndex())


@pytest.mark.parametrize(("shade", "colours"), [(Shade.DARK, DARK), (Shade.CONTRAST, CONTRAST), (Shade.LIGHT, LIGHT)])
def test_colours_are_taken_at_once(screen, shade, colours):
    choose(screen.shade, shade)
    assert QApplication.palette().color(QPalette.ColorRole.Window).name() == colours.window.lower()
    assert preferences.shade() is shade


@pytest.mark.parametrize("scale", [1.0, 1.25, 1.5, 2.0])
def test_text_grows_at_once(screen, scale):
    choose(screen.scale, scale)
    assert screen.sound.font().pointSizeF() == pytest.approx(POINT_SIZE * scale)


def test_text_that_cannot_be_larger_dresses_nothing_anew(driver, screen, qtbot):
    choose(screen.scale, 2.5)
    with qtbot.assertNotEmitted(driver.window.choices.dress_wanted):
        driver.window.choices.enlarge(1)
    assert preferences.text_scale() == 2.5


def test_the_menu_and_the_screen_say_the_same(driver, screen):
    driver.window.menus._shades[Shade.DARK].trigger()
    assert screen.shade.currentData() == Shade.DARK
    choose(screen.shade, Shade.CONTRAST)
    assert driver.window.menus._shades[Shade.CONTRAST].isChecked()


def test_a_language_is_spoken_at_once_on_the_same_screen(driver, screen):
    before = driver.window
    choose(screen.language, Language.GERMAN)
    driver.wait(lambda: driver.window is not before)
    assert driver.window.settings.sound.text() == "Ein Ton"
    assert driver.window.frame.current is driver.window.settings
    driver.window.choices.choose_language(Language.ENGLISH)
    driver.wait(lambda: driver.window.settings.sound.text() == "A sound")


def test_a_language_waits_for_the_stand_and_says_so(driver, screen, long):
    driver.start(long)
    before = driver.window
    driver.window.choices.choose_language(Language.GERMAN)
    (card,) = driver.window.notices.cards
    driver.window.choices.choose_language(Language.ENGLISH)
    assert card.notice.text.startswith("The language changes when the window is opened the next time")
    assert driver.window is before


def test_sound_and_flash_are_kept(screen):
    screen.sound.setChecked(False)
    screen.flash.setChecked(False)
    assert not preferences.calls_by_sound()
    assert not preferences.calls_by_flash()
    screen.sound.setChecked(True)
    screen.flash.setChecked(True)
    assert preferences.calls_by_sound()


@pytest.mark.parametrize("name", ["look/shade", "look/language", "look/text_scale"])
def test_settings_that_cannot_be_read_are_as_usual(settings, name):
    QSettings().setValue(name, "bent")
    assert preferences.shade() in Shade
    assert preferences.language() in Language
    assert preferences.text_scale() == 1.0
