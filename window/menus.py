"""The menus: colours, text size, language, keys."""

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import QObject, QSettings, Signal
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QLabel, QMenu, QMenuBar

from tumble.messages import Language
from tumble.window.look.language import preferred, tr
from tumble.window.look.theme import Shade
from tumble.window.stop_guard import STOP_KEYS
from tumble.window.widgets.dialog import YES_KEY, Dialog

SCALES: Final = (0.8, 1.0, 1.25, 1.5, 2.0, 2.5)


def shade() -> Shade:
    """The colours that were chosen."""
    return Shade(str(QSettings().value("look/shade", Shade.DESKTOP)))


def text_scale() -> float:
    """The size of text that was chosen; 1 is usual."""
    return float(str(QSettings().value("look/text_scale", 1.0)))


def language() -> Language:
    """The language that was chosen, or that of the desktop."""
    return Language(str(QSettings().value("look/language", preferred())))


class Menus(QObject):
    """Fills the bar of a window and keeps what is chosen; says what the window has to do for it."""

    dress_wanted = Signal()
    """Colours or text size were chosen anew."""
    restart_wanted = Signal()
    """Another language was chosen."""
    dialog_wanted = Signal(object)
    """`Dialog`."""
    quit_wanted = Signal()

    def __init__(self, bar: QMenuBar, busy: Callable[[], bool], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._busy = busy
        self._fill_view(bar.addMenu(tr("&View")))
        self._fill_languages(bar.addMenu(tr("&Language")))
        help_menu = bar.addMenu(tr("&Help"))
        _add(help_menu, tr("Keys"), QKeySequence("F1"), self._show_keys)
        _add(help_menu, tr("Quit"), QKeySequence("Ctrl+Q"), self.quit_wanted.emit)

    def _fill_view(self, view: QMenu) -> None:
        group = QActionGroup(view)
        names = {
            Shade.DESKTOP: tr("As the desktop"),
            Shade.LIGHT: tr("Light"),
            Shade.DARK: tr("Dark"),
        }
        for choice, name in names.items():
            action = _add(view, name, None, lambda choice=choice: self._shade(choice))
            _tick(action, group, choice is shade())
        view.addSeparator()
        _add(view, tr("Larger text"), QKeySequence("Ctrl++"), lambda: self._scale(1))
        _add(view, tr("Smaller text"), QKeySequence("Ctrl+-"), lambda: self._scale(-1))

    def _fill_languages(self, languages: QMenu) -> None:
        group = QActionGroup(languages)
        for choice in Language:
            action = _add(languages, choice.endonym, None, lambda choice=choice: self._speak(choice))
            _tick(action, group, choice is language())

    def _shade(self, choice: Shade) -> None:
        QSettings().setValue("look/shade", str(choice))
        self.dress_wanted.emit()

    def _scale(self, way: int) -> None:
        here = min(range(len(SCALES)), key=lambda place: abs(SCALES[place] - text_scale()))
        QSettings().setValue("look/text_scale", SCALES[min(max(here + way, 0), len(SCALES) - 1)])
        self.dress_wanted.emit()

    def _speak(self, choice: Language) -> None:
        QSettings().setValue("look/language", str(choice))
        if self._busy():
            self._tell_language_later()
        else:
            self.restart_wanted.emit()

    def _tell_language_later(self) -> None:
        text = tr("The language changes when the window is opened the next time: the stand is at work.")
        self.dialog_wanted.emit(Dialog(tr("Language"), text))

    def _show_keys(self) -> None:
        self.dialog_wanted.emit(_keys())


def _add(menu: QMenu, text: str, key: QKeySequence | None, do: object) -> QAction:
    action = QAction(text, menu)
    if key is not None:
        action.setShortcut(key)
    action.triggered.connect(lambda _checked: do())  # type: ignore[operator]
    menu.addAction(action)
    return action


def _tick(action: QAction, group: QActionGroup, chosen: bool) -> None:
    action.setCheckable(True)
    group.addAction(action)
    action.setChecked(chosen)


def _keys() -> Dialog:
    keys = {
        ", ".join(STOP_KEYS): tr("stop the head, whatever is going on"),
        "Esc": tr("close a dialog; it stops nothing"),
        "F2": tr("add to the queue; while a run goes on, open the form for that first"),
        "F4": tr("start the queue, or hold it"),
        "Alt+↑ Alt+↓ Del": tr("in the queue: move a line, take it out"),
        "F5": tr("start the run"),
        "F6": tr("pause"),
        "F7": tr("go on after a pause"),
        YES_KEY: tr("yes to the question that is asked"),
        "F9": tr("the unit sits in the mount"),
        "Enter": tr("the head reads as set, or as typed"),
        "Ctrl+1 … Ctrl+4": tr("Stand, Run, Result, Records"),
        "Ctrl+← Ctrl+→": tr("one step with the head"),
        "F8": tr("go to the angle that was typed"),
        "Ctrl+Home": tr("home the head"),
        "Ctrl++ Ctrl+-": tr("larger, smaller text"),
    }
    rows = "".join(f"<tr><td><b>{key}</b>&nbsp;&nbsp;</td><td>{text}</td></tr>" for key, text in keys.items())
    dialog = Dialog(tr("Keys"), "")
    dialog.add(QLabel(f"<table>{rows}</table>"))
    return dialog
