import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PySide6.QtCore import QSettings, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QLabel, QWidget

from tumble import window
from tumble.window.look.language import Language, speak
from tumble.window.look.numbers import local, minutes, parse_number
from tumble.window.look.sentences import in_language

ROOT = Path(window.__file__).parent
TEXTS = ROOT / "translations" / "tumble_uk.ts"


@pytest.fixture
def ukrainian(qapp):
    speak(Language.UKRAINIAN)
    yield
    speak(Language.ENGLISH)


def sources(path):
    messages = ElementTree.parse(path).getroot().iter("context")
    return {
        (context.findtext("name"), message.findtext("source"))
        for context in messages
        for message in context.findall("message")
    }


def test_every_text_of_the_window_is_translated_and_none_is_left_over(tmp_path):
    found = tmp_path / "found.ts"
    lupdate = Path(sys.executable).with_name("pyside6-lupdate")
    subprocess.run([lupdate, *sorted(ROOT.rglob("*.py")), "-ts", found], check=True, capture_output=True)
    assert sources(found) == sources(TEXTS)
    translations = list(ElementTree.parse(TEXTS).getroot().iter("translation"))
    assert all(text.text and text.get("type") is None for text in translations)


def test_translations_keep_what_stands_in_braces():
    for message in ElementTree.parse(TEXTS).getroot().iter("message"):
        source, translation = message.findtext("source"), message.findtext("translation")
        assert sorted(re.findall(r"\{[^}]*\}", source)) == sorted(re.findall(r"\{[^}]*\}", translation)), source


def test_a_whole_run_in_ukrainian(driver, tiny, no_report):
    QSettings().setValue("look/language", str(Language.UKRAINIAN))
    driver.running._restart()
    driver.start(tiny)
    driver.wait_for_result()
    assert "Прогін завершено: програму виконано." in driver.log
    assert driver.window.stop_bar.button.text() == "⬢ СТОП  [F12]"
    assert driver.window.result.table.texts()[0][1].startswith("(2,")
    latin = {
        text
        for part in driver.window.findChildren(QWidget)
        if isinstance(part, QLabel | QAbstractButton)
        for text in re.findall(r"[A-Za-z]{5,}", re.sub(r"<[^>]*>|\[[^]]*\]|\d{8}-\d{6}-[0-9a-f]{6}", "", part.text()))
    }
    assert latin <= {"tumble", "simulated", "English", "alpha"}


def test_a_comma_is_a_decimal_sign_in_either_language():
    assert parse_number("12,5") == parse_number("12.5") == 12.5


def test_numbers_and_units_are_those_of_the_language(ukrainian):
    assert local("1.01643(18) mV/g") == "1,01643(18) мВ/g"
    assert local("0.95 to 1.05 V/g") == "0,95 … 1,05 В/g"


def test_what_the_engine_says_is_said_in_the_language(ukrainian):
    said = in_language("the operator stopped the run; 3 complete points kept in x.mcap; tumble resume goes on")
    assert (
        said
        == "оператор зупинив прогін; повних точок збережено: 3, у x.mcap; прогін можна продовжити на екрані «Записи»"
    )


def test_what_is_not_known_stays_as_it_was_said(ukrainian):
    assert in_language("the frobnicator is bent; straighten it") == "the frobnicator is bent; straighten it"


def test_a_language_chosen_in_the_menu_is_spoken_at_once(driver):
    before = driver.window
    (ukrainian,) = (action for action in before.findChildren(QAction) if action.text() == "Українська")
    ukrainian.trigger()
    driver.wait(lambda: driver.window is not before)
    assert driver.window.run.start_button.text().startswith("Почати")
    assert driver.window.isVisible()
    assert not before.isVisible()


def test_durations_are_read_as_a_clock():
    assert minutes(59.6) == "1:00"
    assert minutes(3671) == "1:01:11"


def test_keys_reach_every_screen(driver):
    for key, screen in zip("1234", driver.window._in_order, strict=True):
        driver.press(getattr(Qt.Key, f"Key_{key}"), Qt.KeyboardModifier.ControlModifier)
        driver.wait(screen.isVisible)
