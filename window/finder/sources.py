"""What there is to find in a window: the window itself is the list, so that none has to be kept."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QCheckBox, QMenu, QMenuBar, QPushButton, QTabWidget, QWidget

from tumble.window.finder.command import Command
from tumble.window.look.keys import KeyedAction
from tumble.window.widgets.motion_button import MotionButton


def of_menus(bar: QMenuBar) -> list[Command]:
    """Every line of the menus that can be chosen now."""
    return [
        _of_action(_plain(menu.title()), line)
        for menu in bar.findChildren(QMenu, options=Qt.FindChildOption.FindDirectChildrenOnly)
        if menu.title()
        for line in menu.actions()
        if line.isEnabled() and not line.isSeparator()
    ]


def of_actions(group: str, actions: Iterable[QAction]) -> list[Command]:
    """Actions under the name of a group."""
    return [_of_action(group, each) for each in actions if each.isEnabled()]


def of_screen(title: str, screen: QWidget, show: Callable[[], None]) -> list[Command]:
    """Every button of a screen that could be pressed if it were shown, and every tab."""
    buttons = [
        button
        for button in screen.findChildren(QAbstractButton)
        if isinstance(button, QPushButton | QCheckBox) and button.isEnabled() and button.isVisibleTo(screen)
    ]
    tabs = [tabs for tabs in screen.findChildren(QTabWidget) if tabs.isEnabled()]
    return [
        *(_of_button(title, button, show) for button in buttons if title_of(button)),
        *(
            Command(group=title, title=_plain(each.tabText(place)), do=partial(_turn_to, show, each, place))
            for each in tabs
            for place in range(each.count())
            if each.isTabVisible(place)
        ),
    ]


def of_names(group: str, names: Sequence[str], use: Callable[[str], None]) -> list[Command]:
    """Names of stands or units, and what is done with the one that is chosen."""
    return [Command(group=group, title=name, do=partial(use, name)) for name in names]


def title_of(button: QAbstractButton) -> str:
    """What a button does: its name for whoever is read to, or its text without a key."""
    return button.accessibleName() or _plain(button.text()).partition("  [")[0]


def _of_action(group: str, action: QAction) -> Command:
    key = action.shortcut().toString(action.shortcut().SequenceFormat.NativeText)
    title = action.key_title if isinstance(action, KeyedAction) else _plain(action.text())
    return Command(group=group, title=title, key=key, do=action.trigger)


def _of_button(group: str, button: QAbstractButton, show: Callable[[], None]) -> Command:
    key = button.shortcut().toString(button.shortcut().SequenceFormat.NativeText)
    moves = isinstance(button, MotionButton)
    is_access_key = "&" in button.text()
    return Command(
        group=group,
        title=title_of(button),
        key="" if is_access_key else key,
        moves=moves,
        do=partial(_press, show, button),
    )


def _press(show: Callable[[], None], button: QAbstractButton) -> None:
    show()
    button.click()


def _turn_to(show: Callable[[], None], tabs: QTabWidget, place: int) -> None:
    show()
    tabs.setCurrentIndex(place)


def _plain(text: str) -> str:
    return text.replace("&", "")
