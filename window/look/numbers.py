"""Numbers and units as the language of the window writes them."""

import re
from typing import Final

from PySide6.QtCore import QLocale

from tumble.messages import Language
from tumble.window.look.language import spoken

_POINT: Final = re.compile(r"(?<=\d)\.(?=\d)")
_UNIT: Final = re.compile(r"(?<![A-Za-z.])(?:[pnµmk]?V|Hz|kHz|ms|s|min|h)(?![A-Za-z])")
_RANGE: Final = re.compile(r"(?<=\d) to (?=[-−\d])")
_CYRILLIC: Final = {
    "V": "В",
    "pV": "пВ",
    "nV": "нВ",
    "µV": "мкВ",
    "mV": "мВ",
    "kV": "кВ",
    "Hz": "Гц",
    "kHz": "кГц",
    "ms": "мс",
    "s": "с",
    "min": "хв",
    "h": "год",
}
"""ДСТУ ISO 80000; g, ° and K are the same in every language."""
_TO: Final = {Language.ENGLISH: " to ", Language.UKRAINIAN: " … ", Language.GERMAN: " bis "}


def local(text: str) -> str:
    """Text with numbers and units in it, with the decimal sign and the units of the language."""
    language = spoken()
    written = _RANGE.sub(_TO[language], _POINT.sub(QLocale().decimalPoint(), text))
    return _UNIT.sub(lambda unit: _CYRILLIC[unit[0]], written) if language is Language.UKRAINIAN else written


def parse_number(text: str) -> float:
    """A number that somebody typed, with comma or point. Raises `ValueError`."""
    return float(text.strip().replace(",", ".").replace("−", "-"))


def minutes(duration_s: float) -> str:
    """`1:05:09`: a duration in hours, minutes and seconds."""
    whole_minutes, seconds = divmod(max(round(duration_s), 0), 60)
    hours, rest = divmod(whole_minutes, 60)
    return f"{hours}:{rest:02d}:{seconds:02d}" if hours else f"{rest}:{seconds:02d}"
