import re
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QSettings, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QLabel, QWidget

from tumble.app.running import failure
from tumble.drivers.errors import CHECK_CABLE, NO_ANSWER, DeviceError, LinkLostError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.messages import Language, Message, translate
from tumble.procedures.errors import StopRequestedError
from tumble.procedures.outcome import outcome_of
from tumble.window.look.language import speak
from tumble.window.look.numbers import local, minutes, parse_number
from tumble.window.look.sentences import in_language


@pytest.fixture
def ukrainian(qapp):
    speak(Language.UKRAINIAN)
    yield
    speak(Language.ENGLISH)


@pytest.fixture
def german(qapp):
    speak(Language.GERMAN)
    yield
    speak(Language.ENGLISH)


def test_a_whole_run_in_ukrainian(driver, tiny, no_report):
    QSettings().setValue("look/language", str(Language.UKRAINIAN))
    driver.running._restart()
    driver.start(tiny)
    driver.wait_for_result()
    assert "Прогін завершено: програму виконано." in driver.log
    assert driver.window.stop_bar.button.text() == "⬢ СТОП  [F12]"
    assert driver.window.result.table.texts()[0][2].startswith("(2,")
    latin = {
        text
        for part in driver.window.findChildren(QWidget)
        if isinstance(part, QLabel | QAbstractButton)
        for text in re.findall(r"[A-Za-z]{5,}", re.sub(r"<[^>]*>|\[[^]]*\]|\d{8}-\d{6}-[0-9a-f]{6}", "", part.text()))
    }
    assert latin <= {"tumble", "simulated", "English", "alpha", "probe"}  # names: of the last a programme


def shown(part):
    return re.sub(r"<[^>]*>", "", part.text())


def test_a_whole_run_in_german(driver, tiny, no_report):
    QSettings().setValue("look/language", str(Language.GERMAN))
    driver.running._restart()
    driver.start(tiny)
    driver.wait_for_result()
    assert "Der Lauf ist beendet: das Programm wurde ausgeführt." in driver.log
    assert driver.window.stop_bar.button.text() == "⬢ STOPP  [F12]"
    parts = driver.window.findChildren(QWidget)
    texts = {shown(part) for part in parts if isinstance(part, QLabel | QAbstractButton)}
    assert {text for text in texts if translate(text, Language.GERMAN) != text} == set()


def test_a_comma_is_a_decimal_sign_in_either_language():
    assert parse_number("12,5") == parse_number("12.5") == 12.5


def test_numbers_and_units_are_those_of_the_language(ukrainian):
    assert local("1.01643(18) mV/g") == "1,01643(18) мВ/g"
    assert local("0.95 to 1.05 V/g") == "0,95 … 1,05 В/g"


def test_numbers_in_german_have_a_comma_and_no_mark_of_thousands(german):
    assert local("0.95 to 1.05 V/g") == "0,95 bis 1,05 V/g"
    assert local("1234.5 s") == "1234,5 s"


def test_dialogs_of_qt_speak_german(german):
    assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Abbrechen"


def test_what_the_engine_says_is_said_in_german(german):
    said = in_language(str(DeviceError(Message("dividing head"), NO_ANSWER, CHECK_CABLE)))
    assert said == "Teilkopf: antwortet nicht; Kabel prüfen, dann den Lauf fortsetzen"


def test_a_message_is_put_into_the_language_with_its_numbers(german):
    assert in_language(Message("The run is over: {message}.", message="1.5")) == "Der Lauf ist beendet: 1,5."


def test_what_the_engine_says_is_said_in_the_language(ukrainian):
    stopped = outcome_of(StopRequestedError(Message("the operator stopped the run")), [], True, "head")
    said = in_language(str(failure(stopped, Path("x.mcap"))))
    assert said == (
        "оператор зупинив прогін; 0 повних точок збережено в x.mcap; "
        "прогін можна продовжити на екрані «Записи» або командою tumble resume"
    )


def test_what_is_not_known_stays_as_it_was_said(ukrainian):
    assert in_language("the frobnicator is bent; straighten it") == "the frobnicator is bent; straighten it"


@pytest.mark.parametrize(("name", "start"), [("Українська", "Почати"), ("Deutsch", "Starten")])
def test_a_language_chosen_in_the_menu_is_spoken_at_once(driver, name, start):
    before = driver.window
    (chosen,) = (action for action in before.findChildren(QAction) if action.text() == name)
    chosen.trigger()
    driver.wait(lambda: driver.window is not before)
    assert driver.window.run.controls.start.text().startswith(start)
    assert driver.window.isVisible()
    assert not before.isVisible()


def test_durations_are_read_as_a_clock():
    assert minutes(59.6) == "1:00"
    assert minutes(3671) == "1:01:11"


def test_keys_reach_every_screen(driver):
    for key, screen in zip("1234", driver.window._in_order, strict=False):
        driver.press(getattr(Qt.Key, f"Key_{key}"), Qt.KeyboardModifier.ControlModifier)
        driver.wait(screen.isVisible)


ENGLISH = re.compile(r"\b(the|is|are|not|and|has|have|then|check|after|at|of|to|it|its|no|with|where|give|cannot)\b")
"""Words without which hardly an English sentence is made, and which are none in German or Ukrainian."""


def fails_at(monkeypatch, number, error):
    """Have the DAQ fail once."""
    acquire, calls = SimulatedDaq.acquire, []

    def failing(*arguments):
        calls.append(arguments)
        if len(calls) == number:
            raise error
        return acquire(*arguments)

    monkeypatch.setattr(SimulatedDaq, "acquire", failing)


@pytest.mark.parametrize("language", [Language.GERMAN, Language.UKRAINIAN])
def test_a_fault_in_mid_run_leaves_no_english_sentence(driver, tiny, tmp_path, monkeypatch, language):
    QSettings().setValue("look/language", str(language))
    driver.running._restart()
    fails_at(monkeypatch, 3 * 2 + 2, DeviceError(Message("multimeter"), NO_ANSWER, CHECK_CABLE))
    driver.start(tiny)
    driver.wait(lambda: driver.complaints)
    (told,) = driver.complaints
    assert len(told) > 50
    assert ENGLISH.findall((told + driver.log).replace(str(tmp_path), "")) == []


def test_a_link_that_comes_back_is_told_in_german_by_log_and_result(driver, tiny, no_report, monkeypatch):
    QSettings().setValue("look/language", str(Language.GERMAN))
    driver.running._restart()
    fails_at(monkeypatch, 3 * 2 + 2, LinkLostError(Message("multimeter"), NO_ANSWER, CHECK_CABLE))
    driver.start(tiny)
    driver.wait_for_result()
    assert "Multimeter: antwortet nicht; Fortsetzung wird versucht" in driver.log
    assert "Multimeter: antwortet nicht; Fortsetzung wird versucht" in driver.window.result._notices.text()
    assert ENGLISH.findall(driver.log) == []
