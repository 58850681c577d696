"""What happens in a run, in plain sentences."""

from datetime import datetime
from typing import Final

from PySide6.QtGui import QFont, QTextCharFormat, QTextCursor
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from tumble.window.look.language import tr

_LINES: Final = 5000


class RunLog(QPlainTextEdit):
    """Sentences with the time of day, the newest at the end; warnings are marked by a sign and bold letters.

    They have no colour of their own, which would outlive a choice of others.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setReadOnly(True)
        self.setMaximumBlockCount(_LINES)
        self.setMinimumHeight(60)
        self.setTabChangesFocus(True)
        self.setAccessibleName(tr("Log of the run"))

    def say(self, sentence: str, warning: bool = False) -> None:
        """Add a sentence."""
        style = QTextCharFormat()
        style.setFontWeight(QFont.Weight.Bold if warning else QFont.Weight.Normal)
        cursor = QTextCursor(self.document())
        cursor.movePosition(QTextCursor.MoveOperation.End)
        sign = "⚠ " if warning else ""
        start = "" if self.document().isEmpty() else "\n"
        cursor.insertText(f"{start}{datetime.now():%H:%M:%S}  {sign}{sentence}", style)
        self.verticalScrollBar().setValue(self.verticalScrollBar().maximum())
