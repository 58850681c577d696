"""The menus: colours, text size, language, and where everything else is found."""

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu, QMenuBar

from tumble.messages import Language
from tumble.window import preferences
from tumble.window.look.keys import KeyedAction
from tumble.window.look.language import tr
from tumble.window.look.names import shade_name
from tumble.window.look.shades import Shade


class Menus(QObject):
    """Fills the bar of a window, and says what is chosen there."""

    shade_wanted = Signal(object)
    """`Shade`."""
    larger_wanted = Signal(int)
    """Text by so many steps larger."""
    language_wanted = Signal(object)
    """`Language`."""
    find_wanted = Signal()
    handbook_wanted = Signal()
    about_wanted = Signal()
    quit_wanted = Signal()

    def __init__(self, bar: QMenuBar, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._shades: dict[Shade, QAction] = {}
        self._fill_view(bar.addMenu(tr("&View")))
        self._fill_languages(bar.addMenu(tr("&Language")))
        help_menu = bar.addMenu(tr("&Help"))
        _plain(help_menu, tr("Handbook"), self.handbook_wanted.emit)
        _plain(help_menu, tr("About tumble"), self.about_wanted.emit)
        _keyed(help_menu, tr("Quit"), "Ctrl+Q", self.quit_wanted.emit)

    def show_choices(self) -> None:
        """Tick the colours that are chosen, wherever that was done."""
        self._shades[preferences.shade()].setChecked(True)

    def _fill_view(self, view: QMenu) -> None:
        group = QActionGroup(view)
        for choice in Shade:
            action = _plain(view, shade_name(choice), partial(self.shade_wanted.emit, choice))
            _tick(action, group, choice is preferences.shade())
            self._shades[choice] = action
        view.addSeparator()
        _keyed(view, tr("Larger text"), "Ctrl++", lambda: self.larger_wanted.emit(1))
        _keyed(view, tr("Smaller text"), "Ctrl+-", lambda: self.larger_wanted.emit(-1))
        view.addSeparator()
        _keyed(view, tr("Find a command…"), "Ctrl+K", self.find_wanted.emit)

    def _fill_languages(self, languages: QMenu) -> None:
        group = QActionGroup(languages)
        for choice in Language:
            action = _plain(languages, choice.endonym, partial(self.language_wanted.emit, choice))
            _tick(action, group, choice is preferences.language())


def _plain(menu: QMenu, text: str, do: Callable[[], None]) -> QAction:
    return _added(menu, QAction(text, menu), do)


def _keyed(menu: QMenu, text: str, usual_key: str, do: Callable[[], None]) -> QAction:
    return _added(menu, KeyedAction(text, usual_key, menu), do)


def _added(menu: QMenu, action: QAction, do: Callable[[], None]) -> QAction:
    action.triggered.connect(lambda _checked: do())
    menu.addAction(action)
    return action


def _tick(action: QAction, group: QActionGroup, chosen: bool) -> None:
    action.setCheckable(True)
    group.addAction(action)
    action.setChecked(chosen)
