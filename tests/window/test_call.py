"""Whoever is waited for is called, once, and not where that is switched off."""

import wave

import pytest
from PySide6.QtCore import QProcess, QStandardPaths
from PySide6.QtWidgets import QApplication, QWidget

from tumble.window import call, preferences
from tumble.window.call import Caller, chime
from tumble.window.screens.run_state import Mood


@pytest.fixture
def heard(monkeypatch, settings):
    """What was called."""
    calls = []
    monkeypatch.setattr(call, "chime", lambda: calls.append("sound"))
    monkeypatch.setattr(QApplication, "alert", lambda _window: calls.append("flash"))
    return calls


@pytest.fixture
def caller(qtbot, heard):
    window = QWidget()
    qtbot.addWidget(window)
    return Caller(window)


def test_a_person_is_called_once_when_the_stand_begins_to_wait(caller, heard):
    for mood in (Mood.MEASURING, Mood.WAITING, Mood.WAITING):
        caller.hear(mood)
    assert heard == ["sound", "flash"]


def test_they_are_called_again_the_next_time(caller, heard):
    for mood in (Mood.WAITING, Mood.MEASURING, Mood.WAITING):
        caller.hear(mood)
    assert heard == ["sound", "flash"] * 2


def test_a_fault_calls_too(caller, heard):
    caller.hear(Mood.FAULT)
    assert heard == ["sound", "flash"]


@pytest.mark.parametrize("mood", [Mood.READY, Mood.MEASURING, Mood.PAUSED])
def test_nothing_else_calls(caller, heard, mood):
    caller.hear(mood)
    assert heard == []


def test_the_sound_can_be_switched_off(caller, heard):
    preferences.choose_sound(False)
    caller.hear(Mood.WAITING)
    assert heard == ["flash"]


def test_the_flash_can_be_switched_off(caller, heard):
    preferences.choose_flash(False)
    caller.hear(Mood.WAITING)
    assert heard == ["sound"]


def test_the_player_of_the_desktop_is_given_two_tones(monkeypatch, tmp_path):
    started = []
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    monkeypatch.setattr(QStandardPaths, "findExecutable", lambda name: "/bin/x" if name == "aplay" else "")
    monkeypatch.setattr(QProcess, "startDetached", lambda program, arguments: started.append((program, arguments)))
    chime()
    ((program, (flag, path)),) = started
    assert (program, flag) == ("/bin/x", "-q")
    with wave.open(path) as tones:
        assert tones.getnframes() / tones.getframerate() == pytest.approx(0.36)


def test_without_a_player_the_desktop_warns_as_it_does(monkeypatch):
    beeped = []
    monkeypatch.setattr(QStandardPaths, "findExecutable", lambda _: "")
    monkeypatch.setattr(QApplication, "beep", lambda: beeped.append(1))
    chime()
    assert beeped == [1]
