"""A window opens whatever its file of settings says: what cannot be is as usual."""

import pytest
from PySide6.QtCore import QByteArray
from window_driver import take_away

from tumble.window import preferences
from tumble.window.kept import kept_place, kept_text
from tumble.window.look.keys import chosen_key
from tumble.window.recent import recent_stands
from tumble.window.start import Application

_GARBAGE = ("banana", "", "-7e400", "nan", "2.5", "99", "-1", QByteArray(b"\x01"), ["1", "2"])
_NAMES = (
    "look/language",
    "look/shade",
    "look/text_scale",
    "call/sound",
    "run/operator",
    "stand/step",
    "stand/recent",
    "simulation/imagined",
    "simulation/speed",
    "window/geometry",
    "window/screen",
    "keys/F5",
)


@pytest.mark.parametrize("garbage", ["banana", QByteArray(b"\x01"), ["9", "9"]])
def test_a_window_opens_whatever_is_kept(qapp, settings, tmp_path, monkeypatch, garbage):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    for name in _NAMES:
        settings.setValue(name, garbage)
    running = Application(qapp, tmp_path / "store")
    try:
        assert running.window.stand.simulation.speed.currentText() == "× 10"
        assert running.window.stand.jog.step.currentText() == "10°"
        assert running.window.frame.current is running.window.stand
    finally:
        take_away(qapp, running)


@pytest.mark.parametrize("garbage", _GARBAGE)
def test_a_place_that_there_is_not_is_the_usual_one(settings, garbage):
    settings.setValue("simulation/speed", garbage)
    assert kept_place("simulation/speed", 2, 4) == 2


def test_a_place_that_there_is_holds(settings):
    settings.setValue("simulation/speed", 3)
    assert kept_place("simulation/speed", 2, 4) == 3


@pytest.mark.parametrize("garbage", ["banana", "-7e400", "nan", QByteArray(b"\x01")])
def test_text_has_its_usual_size_where_none_can_be_read(settings, garbage):
    settings.setValue("look/text_scale", garbage)
    assert preferences.text_scale() == 1.0


def test_bytes_are_no_text(settings):
    settings.setValue("run/operator", QByteArray(b"\x01"))
    assert kept_text("run/operator") == ""


def test_a_key_that_is_none_is_the_usual_one(settings):
    settings.setValue("keys/F5", "banana")
    assert chosen_key("F5").toString() == "F5"


def test_a_number_is_no_stand(settings):
    settings.setValue("stand/recent", 12)
    assert recent_stands() == []
