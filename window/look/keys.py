"""Keys that a person may change: each is known by the one that it usually is."""

from typing import Final

from PySide6.QtCore import QObject, QSettings
from PySide6.QtGui import QAction, QKeySequence

from tumble.window.kept import kept_text

_GROUP: Final = "keys"


def chosen_key(usual: str) -> QKeySequence:
    """The key that a person chose in place of the usual one, or that one."""
    kept = QKeySequence(kept_text(f"{_GROUP}/{_name(usual)}"))
    return kept if kept.toString() else QKeySequence(usual)


def choose_key(usual: str, chosen: QKeySequence) -> None:
    """Keep a key in place of the usual one; the usual one itself ends that."""
    if chosen == QKeySequence(usual):
        QSettings().remove(f"{_GROUP}/{_name(usual)}")
    else:
        QSettings().setValue(f"{_GROUP}/{_name(usual)}", chosen.toString())


def forget_keys() -> None:
    """Have every key as it usually is."""
    QSettings().remove(_GROUP)


def key_text(usual: str) -> str:
    """The key that is chosen, as the desktop writes it."""
    return chosen_key(usual).toString(QKeySequence.SequenceFormat.NativeText)


class KeyedAction(QAction):
    """An action whose key may be changed."""

    def __init__(self, text: str, usual_key: str, parent: QObject | None = None) -> None:
        super().__init__(text, parent)
        self.usual_key = usual_key
        self.take_key()

    @property
    def key_title(self) -> str:
        """What the key does."""
        return self.text().replace("&", "")

    def take_key(self) -> None:
        """Go by the key that is chosen now."""
        self.setShortcut(chosen_key(self.usual_key))
        self.setToolTip(f"{self.key_title}  [{key_text(self.usual_key)}]")


def _name(usual: str) -> str:
    """A slash in a name would be a group of settings."""
    return usual.replace("/", "slash")
