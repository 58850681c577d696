"""Names in letters that look or lie like others: a scanner is a keyboard, and writes by the layout that is chosen."""

from typing import Final

from tumble.window.look.language import tr
from tumble.window.look.names import short_name

_UKRAINIAN: Final = "йцукенгшщзфівапролдячсмить"
_LATIN: Final = "qwertyuiopasdfghjklzxcvbnm"
"""The same keys, row by row (xkeyboard-config, symbols `ua` and `us`)."""
_TOLD: Final = 8
_TO_LATIN: Final = str.maketrans(_UKRAINIAN + _UKRAINIAN.upper(), _LATIN + _LATIN.upper())


def doubt(name: str) -> str:
    """What is doubtful about the letters of a name, in a sentence; empty where nothing is."""
    letters = [letter for letter in name if letter.isalpha()]
    latin = [letter for letter in letters if letter.isascii()]
    cyrillic = [letter for letter in letters if "Ѐ" <= letter <= "ӿ"]
    if latin and cyrillic:
        return tr("Latin and Cyrillic letters in one name: {letters} is Cyrillic.", letters=" ".join(cyrillic[:_TOLD]))
    meant = name.translate(_TO_LATIN)
    if cyrillic and meant.isascii():
        return tr("In Cyrillic letters; with the keyboard on Latin ones it is {meant}.", meant=short_name(meant))
    return ""
