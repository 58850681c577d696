"""Days and times as a language writes them."""

from datetime import date, datetime
from typing import Final

from tumble.messages import Language

_DAY: Final = {Language.ENGLISH: "%Y-%m-%d", Language.UKRAINIAN: "%d.%m.%Y", Language.GERMAN: "%d.%m.%Y"}


def day_of(written: str) -> date | None:
    """The day of an ISO 8601 date or time; None where it is neither."""
    try:
        return datetime.fromisoformat(written).date()
    except ValueError:
        return None


def dated(written: str, language: Language) -> str:
    """An ISO 8601 date or time for a reader, to the minute and with its time zone; anything else as it is."""
    try:
        moment = datetime.fromisoformat(written)
    except ValueError:
        return written
    day = moment.strftime(_DAY[language])
    if len(written) <= len("2026-11-03"):
        return day
    zone = moment.strftime("%z")
    return f"{day} {moment:%H:%M}" + (f" UTC{zone[:3]}:{zone[3:5]}" if zone else "")
