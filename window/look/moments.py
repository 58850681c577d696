"""Moments as the language of the window writes them, in the time of the desktop."""

from datetime import datetime
from math import floor

from PySide6.QtCore import QDate, QDateTime, QLocale


def moment_text(moment: datetime) -> str:
    """A moment as a reader is told it."""
    shown = QDateTime.fromSecsSinceEpoch(floor(moment.timestamp()))
    return QLocale().toString(shown, QLocale.FormatType.ShortFormat)


def day_text(moment: datetime) -> str:
    """The day of a moment, as that shows it in its own zone."""
    return QLocale().toString(QDate(moment.year, moment.month, moment.day), QLocale.FormatType.ShortFormat)


def written_moment_text(written: str) -> str:
    """The same of one in ISO 8601; empty where there is none, and as it is where it is none."""
    try:
        return moment_text(datetime.fromisoformat(written))
    except ValueError:
        return written
