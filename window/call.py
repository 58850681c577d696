"""Calling the person who is waited for: by a sound, and by the window's place on the desktop."""

import math
import struct
import sys
import wave
from pathlib import Path
from typing import Final

from PySide6.QtCore import QObject, QProcess, QStandardPaths
from PySide6.QtWidgets import QApplication, QWidget

from tumble.drivers.private_files import private_folder
from tumble.window.preferences import calls_by_flash, calls_by_sound
from tumble.window.screens.run_state import Mood

_CALLING: Final = frozenset({Mood.WAITING, Mood.FAULT})
_PLAYERS: Final = (("pw-play",), ("paplay",), ("afplay",), ("aplay", "-q"))
"""What desktops play a file with; the first that is installed is used."""
_RATE_HZ: Final = 22_050
_TONES_HZ: Final = (880.0, 1174.7)
"""A fourth, upwards: A5 and D6."""
_TONE_S: Final = 0.18
_LOUDNESS: Final = 0.4
"""Of what can be written."""


class Caller(QObject):
    """Calls once whenever the stand begins to wait for somebody, or has a fault."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._mood = Mood.READY

    def hear(self, mood: Mood) -> None:
        """Call where the stand has come to wait since it was heard last."""
        before, self._mood = self._mood, mood
        if mood in _CALLING and mood is not before:
            self.call()

    def call(self) -> None:
        """Call by what is not switched off."""
        if calls_by_sound():
            chime()
        if calls_by_flash():
            QApplication.alert(self._window)


def chime() -> None:
    """Two tones by the player of the desktop; where there is none, the sound that the desktop gives a warning."""
    if sys.platform == "win32":
        import winsound

        winsound.PlaySound(str(_tones()), winsound.SND_FILENAME | winsound.SND_ASYNC)
        return
    for player, *flags in _PLAYERS:
        if found := QStandardPaths.findExecutable(player):
            try:
                QProcess.startDetached(found, [*flags, str(_tones())])
            except OSError:  # nowhere to keep them
                break
            return
    QApplication.beep()


def _tones() -> Path:
    """The file of the tones, made where there is none. Raises `OSError`."""
    path = private_folder("sounds") / "waiting.wav"
    if not path.is_file():
        begun = path.with_suffix(".new")
        with wave.open(str(begun), "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(_RATE_HZ)
            file.writeframes(b"".join(_tone(each) for each in _TONES_HZ))
        begun.replace(path)
    return path


def _tone(frequency_hz: float) -> bytes:
    """Samples of 16 bits that rise and fall, without a click at either end."""
    count = round(_TONE_S * _RATE_HZ)
    levels = (
        _LOUDNESS * math.sin(math.pi * at / count) * math.sin(2 * math.pi * frequency_hz * at / _RATE_HZ)
        for at in range(count)
    )
    return b"".join(struct.pack("<h", round(32_767 * level)) for level in levels)
