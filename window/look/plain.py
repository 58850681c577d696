"""Text of files, records and people is shown as it is: Qt would take `<b>` in it for markup."""

from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget


class PlainLabel(QLabel):
    """A label that shows text as it is."""

    def __init__(self, text: str = "", parent: QWidget | None = None) -> None:
        super().__init__(text, parent)
        self.setTextFormat(Qt.TextFormat.PlainText)


def as_tooltip(text: str) -> str:
    """Text for a tooltip, which knows no other way to be told that text is no markup."""
    return f"<p>{escape(text)}</p>" if "<" in text else text
