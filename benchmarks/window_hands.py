"""A person at the window who has a keyboard and eyes: keys go to whatever has the focus, as those of a keyboard do."""

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from PySide6.QtCore import QSettings
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QWidget

from tumble.window.start import Application, application

_MOST_TABS = 60
_BUTTON_S = 0.2
_LOOK_S = 0.05


class StuckError(Exception):
    """What the person wants cannot be done, or does not come."""


class Hands:
    """Presses keys, and waits for what is seen of them."""

    def __init__(self, window: QWidget) -> None:
        self.window = window
        self.pressed = 0

    def press(self, keys: str) -> None:
        """Press a key, or several at once, by their names."""
        combination = QKeySequence(keys)[0]
        self._strike(combination.key(), combination.keyboardModifiers())

    def type(self, text: str) -> None:
        """Type letters."""
        for letter in text:
            self._strike(letter)

    def access(self, letter: str) -> None:
        """Press Alt and the letter that is underlined."""
        self.push(f"Alt+{letter}")

    def push(self, keys: str) -> None:
        """Press the key of a button, which is seen to go down, and acts when it comes up."""
        self.press(keys)
        look_on(_BUTTON_S)

    def scan(self, text: str) -> None:
        """Type as a barcode scanner does, with Enter at the end."""
        self.type(text)
        self.press("Return")

    def tab_to(self, wanted: QWidget) -> None:
        """Press Tab until something has the focus."""
        seen = []
        for _ in range(_MOST_TABS):
            here = QApplication.focusWidget()
            if here is wanted:
                return
            seen.append(named(here))
            self.press("Tab")
        raise StuckError(f"no Tab reaches {named(wanted)}, but: {', '.join(dict.fromkeys(seen))}")

    def choose(self, box: QComboBox, text: str) -> None:
        """Choose in a list by typing how it begins, and by the arrows from there."""
        if QApplication.focusWidget() is not box:
            raise StuckError(f"{named(QApplication.focusWidget())} has the focus, and not the list")
        if " " not in text:  # a space opens the list
            self.type(text)
        for key in ("Down", "Up"):
            for _ in range(box.count()):
                if box.currentText() == text:
                    return
                self.press(key)
        raise StuckError(f"no key chooses {text}; {box.currentText()} is chosen")

    def wait(self, condition: Callable[[], object], what: str, within_s: float = 60.0) -> None:
        """Look until something is seen."""
        until = time.monotonic() + within_s
        while not condition():
            if time.monotonic() > until:
                raise StuckError(f"{what} does not come within {within_s:.0f} s")
            look_on(_LOOK_S)

    def _strike(self, key: object, modifiers: object = None) -> None:
        window = QApplication.focusWindow()
        if window is None:
            raise StuckError("nothing has the keyboard")
        held = () if modifiers is None else (modifiers,)
        QTest.keyClick(window, key, *held)
        QApplication.processEvents()
        self.pressed += 1


@contextmanager
def window_in_english() -> Iterator[tuple[Application, Hands, Path]]:
    """A window with settings, store and state of its own, the person at it, and the folder of all that."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["XDG_STATE_HOME"] = name
        QSettings.setDefaultFormat(QSettings.Format.IniFormat)
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, name)
        QSettings().setValue("look/language", "en")
        running = Application(application(), folder / "store")
        hands = Hands(running.window)
        running.window.activateWindow()
        hands.wait(running.window.isActiveWindow, "the window")
        yield running, hands, folder
        if running.window.isVisible():
            running.window.leave()


def look_on(for_s: float) -> None:
    """Let the window and its threads go on; `QTest.qWait` would keep the threads waiting, too."""
    until = time.monotonic() + for_s
    while time.monotonic() < until:
        QApplication.processEvents()
        time.sleep(0.005)


def named(part: QWidget | None) -> str:
    """A part of the window in a few words."""
    if part is None:
        return "nothing"
    text = getattr(part, "text", None)
    words = part.accessibleName() or (text() if callable(text) else "")
    return f"{type(part).__name__} “{words[:30]}”"
