"""The screen Settings: look, language, calls and keys; what is chosen holds at once."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFormLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from tumble.messages import Language
from tumble.window import preferences
from tumble.window.call import chime
from tumble.window.look.language import tr
from tumble.window.look.names import shade_name
from tumble.window.look.shades import Shade
from tumble.window.preferences import SCALES
from tumble.window.shortcuts import Shortcut
from tumble.window.widgets.key_fields import KeyFields


class SettingsScreen(QWidget):
    """Cards of what can be chosen."""

    shade_wanted = Signal(object)
    """`Shade`."""
    scale_wanted = Signal(float)
    language_wanted = Signal(object)
    """`Language`."""
    keys_changed = Signal()

    def __init__(self, find_keys: Callable[[], Sequence[Shortcut]], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.language, self.shade, self.scale = QComboBox(), QComboBox(), QComboBox()
        for language in Language:
            self.language.addItem(language.endonym, language)
        for shade in Shade:
            self.shade.addItem(shade_name(shade), shade)
        for scale in SCALES:
            self.scale.addItem(f"{scale:.0%}", scale)
        self.sound = QCheckBox(tr("A sound"))
        self.flash = QCheckBox(tr("The window asks for attention on the desktop"))
        self.try_button = QPushButton(tr("Hear it"))
        self.keys = KeyFields(find_keys)
        self.show_choices()
        self._lay_out()
        self._connect()

    def show_choices(self) -> None:
        """Show what is chosen, wherever that was done."""
        for box, chosen in (
            (self.language, preferences.language()),
            (self.shade, preferences.shade()),
            (self.scale, preferences.text_scale()),
        ):
            box.setCurrentIndex(box.findData(chosen))
        self.sound.setChecked(preferences.calls_by_sound())
        self.flash.setChecked(preferences.calls_by_flash())

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Show what may have changed since."""
        super().showEvent(event)
        self.show_choices()
        self.keys.show_keys()

    def _connect(self) -> None:
        self.language.activated.connect(lambda _: self.language_wanted.emit(Language(self.language.currentData())))
        self.shade.activated.connect(lambda _: self.shade_wanted.emit(Shade(self.shade.currentData())))
        self.scale.activated.connect(lambda _: self.scale_wanted.emit(self.scale.currentData()))
        self.sound.toggled.connect(preferences.choose_sound)
        self.flash.toggled.connect(preferences.choose_flash)
        self.try_button.clicked.connect(lambda _checked: chime())
        self.keys.changed.connect(self.keys_changed)

    def _lay_out(self) -> None:
        look = QFormLayout()
        for title, box in (
            (tr("Lan&guage"), self.language),
            (tr("&Colours"), self.shade),
            (tr("Size of &text"), self.scale),
        ):
            look.addRow(title, box)
        calls = QVBoxLayout()
        sound = QHBoxLayout()
        sound.addWidget(self.sound)
        sound.addWidget(self.try_button)
        sound.addStretch(1)
        calls.addLayout(sound)
        calls.addWidget(self.flash)
        keys = QVBoxLayout()
        keys.addWidget(self.keys)
        column = QVBoxLayout(self)
        for title, part in (
            (tr("Look and language"), look),
            (tr("When somebody is waited for"), calls),
            (tr("Keys: press one in a field to change it"), keys),
        ):
            column.addWidget(_card(title, part))
        column.addStretch(1)


def _card(title: str, part: QFormLayout | QVBoxLayout) -> QFrame:
    card, heading = QFrame(), QLabel(title)
    card.setObjectName("card")
    heading.setObjectName("heading")
    column = QVBoxLayout(card)
    column.addWidget(heading)
    column.addLayout(part)
    return card
