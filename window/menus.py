"""The menus: colours, text size, language, keys."""

from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QSettings
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QLabel, QMenu

from tumble.messages import Language
from tumble.window.look.language import preferred, tr
from tumble.window.look.theme import Shade
from tumble.window.stop_guard import STOP_KEYS
from tumble.window.widgets.dialog import YES_KEY, Dialog

if TYPE_CHECKING:
    from tumble.window.main_window import MainWindow

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


def fill_menus(window: "MainWindow") -> None:
    """Give a window its menus."""
    view = window.menuBar().addMenu(tr("&View"))
    _fill_shades(window, view)
    view.addSeparator()
    _add(view, tr("Larger text"), QKeySequence("Ctrl++"), lambda: _scale(window, 1))
    _add(view, tr("Smaller text"), QKeySequence("Ctrl+-"), lambda: _scale(window, -1))
    languages = window.menuBar().addMenu(tr("&Language"))
    group = QActionGroup(languages)
    for choice in Language:
        action = _add(languages, choice.endonym, None, lambda choice=choice: _speak(window, choice))
        _tick(action, group, choice is language())
    help_menu = window.menuBar().addMenu(tr("&Help"))
    _add(help_menu, tr("Keys"), QKeySequence("F1"), lambda: _show_keys(window))
    _add(help_menu, tr("Quit"), QKeySequence("Ctrl+Q"), window.close)


def _fill_shades(window: "MainWindow", view: QMenu) -> None:
    group = QActionGroup(view)
    names = {
        Shade.DESKTOP: tr("As the desktop"),
        Shade.LIGHT: tr("Light"),
        Shade.DARK: tr("Dark"),
    }
    for choice, name in names.items():
        action = _add(view, name, None, lambda choice=choice: _shade(window, choice))
        _tick(action, group, choice is shade())


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


def _shade(window: "MainWindow", choice: Shade) -> None:
    QSettings().setValue("look/shade", str(choice))
    window.dress_wanted.emit()


def _scale(window: "MainWindow", way: int) -> None:
    here = min(range(len(SCALES)), key=lambda place: abs(SCALES[place] - text_scale()))
    QSettings().setValue("look/text_scale", SCALES[min(max(here + way, 0), len(SCALES) - 1)])
    window.dress_wanted.emit()


def _speak(window: "MainWindow", choice: Language) -> None:
    QSettings().setValue("look/language", str(choice))
    if window.busy:
        _tell_language_later(window)
    else:
        window.restart_wanted.emit()


def _tell_language_later(window: "MainWindow") -> None:
    text = tr("The language changes when the window is opened the next time: the stand is at work.")
    window.dialogs.show_dialog(Dialog(tr("Language"), text))


def _show_keys(window: "MainWindow") -> None:
    keys = {
        ", ".join(STOP_KEYS): tr("stop the head, whatever is going on"),
        "Esc": tr("close a dialog; it stops nothing"),
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
    window.dialogs.show_dialog(dialog)
