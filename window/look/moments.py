"""Moments as the language of the window writes them, in the time of the desktop."""

from datetime import datetime

from PySide6.QtCore import QDateTime, QLocale


def moment_text(written: str) -> str:
    """An ISO 8601 moment as a reader is told it; empty where there is none, and as it is where it is none."""
    try:
        moment = datetime.fromisoformat(written)
    except ValueError:
        return written
    shown = QDateTime.fromSecsSinceEpoch(round(moment.timestamp()))
    return QLocale().toString(shown, QLocale.FormatType.ShortFormat)
