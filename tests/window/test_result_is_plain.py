"""The screen Result says each thing once, in words of the screen and times of the language."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QSettings
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLineEdit

from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.messages import Language, Message
from tumble.window.look.language import speak
from tumble.window.look.moments import written_moment_text
from tumble.window.look.shades import Shade
from tumble.window.look.theme import dress, dress_window
from tumble.window.screens.result import notices_of

BELOW = Message("What that does to the parameters is said below the results.")


@pytest.fixture
def told(qapp):
    """Makes what is shown of some notices and judgements."""

    def make(*notices, judged=()):
        return SimpleNamespace(
            notices=notices,
            verdict=Verdict(judged=Model.DECLARED, parameters=judged),
            concluded=SimpleNamespace(recordings=(Path("/home/h/store/SN-1/a.mcap"),)),
        )

    speak(Language.ENGLISH)
    return make


def test_what_a_page_says_of_itself_is_left_out(told):
    found = Message.joined(" ", [Message("k_xxx was found."), BELOW])
    assert notices_of(told(found)) == ["k_xxx was found."]


def test_a_recording_goes_by_its_name(told):
    assert notices_of(told("/home/h/store/SN-1/a.mcap: row 7 is set aside")) == ["a.mcap: row 7 is set aside"]


def test_each_warning_is_said_once(told):
    judged = Judgement(name="ky", outcome=Outcome.NOT_DECIDED, reason="it rests on kxy alone")
    assert notices_of(told(judged.sentence, "cold", "cold", judged=(judged,))) == [
        "ky not decided: it rests on kxy alone",
        "cold",
    ]


def test_a_command_of_the_terminal_is_not_told(told):
    remedy = Message("one sweep would settle it: {command}", command="tumble run")
    judged = Judgement(name="ky", outcome=Outcome.NOT_DECIDED, reason="it rests on kxy alone", remedy=remedy)
    assert notices_of(told(judged=(judged,))) == ["ky not decided: it rests on kxy alone"]


def test_what_to_do_is_told(told):
    judged = Judgement(name="ky", outcome=Outcome.NOT_DECIDED, reason="it scatters", remedy="measure again")
    assert notices_of(told(judged=(judged,))) == ["ky not decided: it scatters; measure again"]


def test_a_moment_is_written_as_the_language_writes_it(qapp):
    texts = []
    for language in Language:
        speak(language)
        texts.append(written_moment_text("2026-11-27T12:15:00+00:00"))
    speak(Language.ENGLISH)
    assert all("T" not in text for text in texts)
    assert texts[2].startswith("27.11.26")


@pytest.mark.parametrize("text", ["", "some day"])
def test_what_is_no_moment_stays_what_it_is(text):
    assert written_moment_text(text) == text


def test_warnings_without_limits_are_in_the_headline(driver, tiny, no_report):
    driver.start(tiny)
    presentation = driver.wait_for_result()
    driver.window.result._show(replace(presentation, notices=("The recording is incomplete.",)))
    assert "read the warnings before you use a value" in driver.window.result.verdict.text()


@pytest.mark.parametrize("shade", [Shade.LIGHT, Shade.DARK])
def test_the_edge_of_a_text_field_is_seen(qtbot, qapp, settings, shade):
    field = QLineEdit()
    qtbot.addWidget(field)
    try:
        dress(qapp, shade, 1.0)
        dress_window(field, 1.0)
        field.resize(200, 40)
        picture = field.grab().toImage()
        edge, ground = picture.pixelColor(100, 0), QColor(field.palette().window().color())
        assert contrast(edge, ground) >= 3.0  # WCAG 2.1, 1.4.11
    finally:
        QSettings().setValue("look/shade", "light")
        dress(qapp, Shade.LIGHT, 1.0)


def contrast(one, other):
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def luminance(colour):
    parts = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in colour.getRgbF()]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]
