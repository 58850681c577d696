"""Numbers and units in a text, as a language writes them."""

import re
from collections.abc import Collection
from typing import Final

from tumble.messages import AsWritten, Language, Message

_NUMBER: Final = re.compile(r"(?<![\w./\\])(?<![A-Za-z]-)(\d+)\.(\d+)(?=e[+-]?\d|(?![\d_A-Za-z]|\.\w))")
"""A decimal number; no version, and no part of the name of a file or of a serial number."""
_UNIT: Final = re.compile(r"(?<![A-Za-z_.])(?:[pnµmk]?V|Hz|kHz|ms|s|min|h)(?![A-Za-z_])")
_RANGE: Final = re.compile(r"(?<=[\d°″%]) to (?=[-−\d])")
_PER_CENT: Final = re.compile(r"(?<=\d)%(?!\w)")
_DATA: Final = re.compile(
    r"(?<![\w/°′″%])(?:~|\.{0,2}|file:)/[^\s:;,()\"']+"  # a path from the root, from home, or from here; no rate
    r"|(?:\b[A-Za-z]:\\|\\\\)[^\s:;,()\"']+"  # one of Windows
    r"|[\w.~-]+(?:[/\\][\w.~-]+)*\.[a-z]\w{1,5}\b"  # the name of a file or of a host, with a folder or without
    r"|\d+(?:\.\d+){2,}(?::\d+)?"  # an address, a version
    r"|(?<!\w)b?(['\"])(?:(?!\1)[^\\\n]|\\.)*\1(?!\w)"  # what was typed, or answered by a device
    r"|--[a-z][a-z-]*[ =][^\s,;]+"  # an option of a command
)
"""Names, addresses, commands and what is quoted, which are the same in every language."""
_PER: Final = re.compile(r"(?<=/)(?:run|turn)\b")
_COUNTED: Final = {
    Language.UKRAINIAN: {"run": "прогін", "turn": "оберт"},
    Language.GERMAN: {"run": "Lauf", "turn": "Umdrehung"},
}
"""What is counted and has no symbol: `mV/run`."""
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
_TO: Final = {Language.UKRAINIAN: " … ", Language.GERMAN: " bis "}


def localised(text: str, language: Language, kept: Collection[str] = ()) -> str:
    """Text with numbers and units in it, with the decimal sign, the ranges and the units of a language.

    Paths, names of files, addresses, options of commands and what is quoted stay as they are; so does
    text that is `AsWritten`, and what is `kept`.
    """
    if language is Language.ENGLISH or isinstance(text, AsWritten):
        return text
    if not kept:
        return _localised(text, language)
    words = "|".join(map(re.escape, sorted(kept, key=len, reverse=True)))
    parts = re.split(rf"(?<![\w.])({words})(?!\w|\.\w)", text)
    return "".join(part if place % 2 else _localised(part, language) for place, part in enumerate(parts))


def in_words_of(message: Message, language: Language) -> str:
    """A message in a language, with its numbers and units; what is `AsWritten` in it stays so."""
    return localised(message.in_language(language), language, message.as_written())


def _localised(text: str, language: Language) -> str:
    written, end = "", 0
    for data in _DATA.finditer(text):
        written += _written(text[end : data.start()], language) + data[0]
        end = data.end()
    return written + _written(text[end:], language)


def _written(text: str, language: Language) -> str:
    written = _RANGE.sub(_TO[language], _NUMBER.sub(r"\1,\2", text))
    written = _PER_CENT.sub("\u00a0%", written)
    written = _PER.sub(lambda word: _COUNTED[language][word[0]], written)
    return _UNIT.sub(lambda unit: _CYRILLIC[unit[0]], written) if language is Language.UKRAINIAN else written
