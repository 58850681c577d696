"""Angles as people write them: degrees, minutes and seconds, or decimal degrees."""

import re
from typing import Final

from tumble.messages import Message

_NUMBER = r"(\d+(?:[.,]\d+)?)"
_DEGREE_END = r"(?:\s*(?:°|º|deg|d|:)\s*|\s+)"
_MINUTE_END = r"(?:\s*(?:′|'|min|m|:)\s*|\s+)"
_READING: Final = re.compile(
    rf"([+\-−–]?)\s*{_NUMBER}"
    rf"(?:{_DEGREE_END}{_NUMBER}(?:{_MINUTE_END}{_NUMBER}\s*(?:″|\"|''|′′|sec|s)?|\s*(?:′|'|min|m)?)|\s*(?:°|º|deg|d)?)",
    re.IGNORECASE,
)


def parse_reading(text: str) -> float:
    """Angle in degrees that somebody typed.

    Understood are `12°34′56″`, `12 34 56`, `12:34:56`, `12d34m56s`, the same with the seconds or the minutes left out,
    and decimal degrees; a fraction, with point or comma, may stand in the last number only. The sign belongs to the
    whole: `-0 30` is half a degree below zero.

    Raises
    ------
    ValueError
        One sentence on what is wrong.
    """
    found = _READING.fullmatch(text.strip())
    if found is None:
        raise ValueError(
            Message(
                "{text!r} is no angle; type degrees, minutes and seconds, such as 12 34 56, or 12.5", text=text.strip()
            )
        )
    sign, *written = found.groups()
    parts = [part for part in written if part is not None]
    if any("." in part or "," in part for part in parts[:-1]):
        raise ValueError(Message("{text!r} has a fraction before its last number; type it without", text=text.strip()))
    degrees, minutes, seconds = (*(float(part.replace(",", ".")) for part in parts), 0.0, 0.0)[:3]
    if minutes >= 60.0 or seconds >= 60.0:
        raise ValueError(
            Message("{text!r} has 60 minutes or seconds, or more; type it with fewer than 60", text=text.strip())
        )
    size_deg = (degrees * 3600.0 + minutes * 60.0 + seconds) / 3600.0
    return -size_deg if sign in {"-", "−", "–"} else size_deg


def format_dms(angle_deg: float) -> str:
    """An angle to a tenth of a second: `-12° 34′ 56″`, `0° 00′ 07.5″`."""
    tenths = round(abs(angle_deg) * 36000.0)
    minutes, tenths_left = divmod(tenths, 600)
    seconds = f"{tenths_left // 10:02d}" + (f".{tenths_left % 10}" if tenths_left % 10 else "")
    sign = "-" if angle_deg < 0 and tenths else ""
    return f"{sign}{minutes // 60}° {minutes % 60:02d}′ {seconds}″"


def on_the_circle(angle_deg: float) -> str:
    """An angle as the circle of a head shows it, from 0° to 360°: `35° 00′ 00″` for 395 degrees."""
    tenths = round(angle_deg * 36000.0) % (360 * 36000)
    return format_dms(tenths / 36000.0)
