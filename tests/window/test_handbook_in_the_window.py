"""The handbook is read in the window, from the files that came with it."""

import re

import pytest
from PySide6.QtCore import Qt, QUrl

from tumble.window.handbook import CONTENTS, FIRST_PAGE, handbook


@pytest.fixture
def screen(lent_driver):
    """The screen Help of a window that was lent."""
    lent_driver.press(Qt.Key.Key_F1)
    lent_driver.wait(lent_driver.window.help.isVisible)
    return lent_driver.window.help


def test_it_begins_with_how_the_window_is_worked(screen):
    assert screen.reader.source().fileName() == FIRST_PAGE
    assert screen.reader.toPlainText().startswith("The operator's window")


def test_a_link_leads_to_another_page_and_back(screen):
    screen.open_handbook()
    screen._open(CONTENTS)
    screen.reader.setSource(QUrl("glossary.md"))
    assert screen.reader.source().fileName() == "glossary.md"
    screen.reader.backward()
    assert screen.reader.source().fileName() == CONTENTS


def test_a_link_that_leads_nowhere_leaves_the_page(screen):
    screen.open_handbook()
    screen.reader.setSource(QUrl("absent.md"))
    assert screen.reader.source().fileName() == FIRST_PAGE


def test_every_key_is_listed_as_it_is_now(screen):
    screen.open_keys()
    listed = screen.reader.toPlainText()
    assert "F12, Pause, Ctrl+.\nstop the head, whatever is going on" in listed
    assert "F6\nPause" in listed


def test_it_says_what_program_it_is(screen):
    screen.open_about()
    told = screen.reader.toPlainText()
    assert re.search(r"Version\n\d+\.\d+", told)
    assert "BSD-3-Clause" in told


def test_the_about_of_the_menu_leads_there(lent_driver):
    lent_driver.window.menus.about_wanted.emit()
    assert lent_driver.window.frame.current is lent_driver.window.help
    assert lent_driver.window.help.reader.toPlainText().startswith("About tumble")


def test_the_handbook_is_there():
    assert (handbook() / FIRST_PAGE).is_file()


def test_without_a_handbook_the_keys_are_shown(lent_driver, monkeypatch):
    screen = lent_driver.window.help
    monkeypatch.setattr(screen, "_folder", None)
    screen.open_handbook()
    assert screen.reader.toPlainText().startswith("Keys")


@pytest.mark.parametrize("width", [900, 1264])
def test_pictures_are_as_wide_as_their_share_of_the_page(lent_driver, screen, width):
    screen.open_handbook()
    lent_driver.window.resize(width, 760)
    room = round(0.42 * screen.reader.viewport().width())
    widths = {part.charFormat().toImageFormat().width() for part in screen.reader._pictures()}
    assert widths == {room}
