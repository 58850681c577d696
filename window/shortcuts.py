"""Keys of a window as a person may change them: which there are, and which are refused, in one sentence."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from PySide6.QtCore import QKeyCombination, QObject, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QWidget

from tumble.window.look.keys import KeyedAction, chosen_key
from tumble.window.look.language import tr
from tumble.window.stop_guard import STOP_KEYS
from tumble.window.widgets.dialog import YES_KEY
from tumble.window.widgets.motion_button import MotionButton

_FIXED: Final = ("Esc", "Return", "Enter", "Tab", "Shift+Tab", "Backspace", "Del", "Home", "Menu", YES_KEY)
"""What dialogs, fields and plots go by."""
_EDITING: Final = (
    QKeySequence.StandardKey.Copy,
    QKeySequence.StandardKey.Cut,
    QKeySequence.StandardKey.Paste,
    QKeySequence.StandardKey.Undo,
    QKeySequence.StandardKey.Redo,
    QKeySequence.StandardKey.SelectAll,
    QKeySequence.StandardKey.Save,
)
_PLAIN: Final = Qt.KeyboardModifier.NoModifier
_SHIFTED: Final = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier
_FUNCTION_KEYS: Final = range(Qt.Key.Key_F1, Qt.Key.Key_F35 + 1)
_AROUND: Final = range(Qt.Key.Key_Home, Qt.Key.Key_PageDown + 1)
"""Home, End, the arrows and the pages: with Ctrl no scanner types them."""


@dataclass(frozen=True, kw_only=True)
class Shortcut:
    """A key, and everything in the window that goes by it."""

    usual: str
    title: str
    moves: bool
    """Whether it starts motion, so that no barcode scanner may be able to type it."""

    @property
    def chosen(self) -> QKeySequence:
        """The key that it is now."""
        return chosen_key(self.usual)


def shortcuts(window: QWidget) -> list[Shortcut]:
    """Every key of a window that may be changed; those that start motion are the last."""
    found: dict[str, list[MotionButton | KeyedAction]] = {}
    for each in _keyed(window):
        if each.usual_key != YES_KEY:
            found.setdefault(each.usual_key, []).append(each)
    listed = [
        Shortcut(
            usual=usual,
            title=" / ".join(dict.fromkeys(part.key_title for part in parts)),
            moves=any(isinstance(part, MotionButton) for part in parts),
        )
        for usual, parts in found.items()
    ]
    return sorted(listed, key=lambda each: (each.moves, each.usual if each.moves else ""))


def take_keys(window: QWidget) -> None:
    """Have everything in a window go by the keys that are chosen now."""
    for each in _keyed(window):
        each.take_key()


def refusal(wanted: QKeySequence, shortcut: Shortcut, others: Sequence[Shortcut]) -> str:
    """Why a key cannot be that of a shortcut, in one sentence; empty where it can."""
    written = wanted.toString(QKeySequence.SequenceFormat.NativeText)
    taken = next((each for each in others if each.usual != shortcut.usual and each.chosen == wanted), None)
    if wanted.toString() in STOP_KEYS:
        return tr("{key} stops the head, and goes on doing so: choose another key.", key=written)
    if taken is not None:
        return tr(
            "{key} is the key of “{title}”: choose another, or change that one first.", key=written, title=taken.title
        )
    if wanted.toString() in _FIXED or any(wanted in QKeySequence.keyBindings(each) for each in _EDITING):
        return tr("{key} is what fields, plots and questions go by: choose another key.", key=written)
    if shortcut.moves and not _beyond_scanners(wanted):
        return tr(
            "{key} could be typed by a barcode scanner, and this starts motion: choose a function key, or Ctrl with "
            "an arrow, Home, End or a page key.",
            key=written,
        )
    if _is_typed(wanted):
        return tr("{key} is typed in fields: choose a function key, or one with Ctrl.", key=written)
    return ""


def _keyed(window: QWidget) -> list[MotionButton | KeyedAction]:
    return [each for each in window.findChildren(QObject) if isinstance(each, MotionButton | KeyedAction)]


def _beyond_scanners(keys: QKeySequence) -> bool:
    """Whether no barcode scanner types a key: these send letters, some of them with Ctrl, and Enter."""
    pressed = _pressed(keys)
    with_ctrl = bool(pressed.keyboardModifiers() & Qt.KeyboardModifier.ControlModifier)
    return pressed.key() in _FUNCTION_KEYS or (with_ctrl and pressed.key() in _AROUND)


def _is_typed(keys: QKeySequence) -> bool:
    """Whether a key writes something, goes somewhere in a field, or opens a menu."""
    pressed = _pressed(keys)
    held = pressed.keyboardModifiers() & ~_SHIFTED
    is_letter = pressed.key() < Qt.Key.Key_Escape
    return pressed.key() not in _FUNCTION_KEYS and (
        held == _PLAIN or (held == Qt.KeyboardModifier.AltModifier and is_letter)
    )


def _pressed(keys: QKeySequence) -> QKeyCombination:
    return keys[0]  # type: ignore[index,no-any-return]  # the stubs do not know that
