"""The language of SCPI instruments: messages into commands, headers into entries of a table, text into values.

SCPI-1999, volume 1, chapter 6 (headers and their paths) and chapter 7 (parameters); IEEE 488.2-1992, chapter 7.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Generic, TypeVar

Entry = TypeVar("Entry")

MESSAGES: Mapping[int, str] = {
    0: "No error",
    -102: "Syntax error",
    -108: "Parameter not allowed",
    -109: "Missing parameter",
    -113: "Undefined header",
    -121: "Invalid character in number",
    -131: "Invalid suffix",
    -138: "Suffix not allowed",
    -151: "Invalid string data",
    -211: "Trigger ignored",
    -213: "Init ignored",
    -214: "Trigger deadlock",
    -221: "Settings conflict",
    -222: "Data out of range",
    -224: "Illegal parameter value",
    -230: "Data corrupt or stale",
    -310: "System error",
    -350: "Queue overflow",
    -410: "Query INTERRUPTED",
    -440: "Query UNTERMINATED after indefinite response",
}
"""Standard errors and events (SCPI-1999, volume 2, 21.8)."""

_UNIT = re.compile(r"""\s*(?P<header>[*:]?[A-Za-z][A-Za-z0-9_:]*\??)(?:\s+(?P<parameters>.*?))?\s*""", re.DOTALL)
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:\s*E\s*[+-]?\d{1,3})?)\s*([A-Z/%]*)")
_NODE = re.compile(r"(\[?):?([A-Z]+)([a-z]*)(\d*)")
_ENCLOSING = frozenset("\"'()")
_PREFIXES: Mapping[str, float] = {"": 1.0, "N": 1e-9, "U": 1e-6, "M": 1e-3, "K": 1e3, "MA": 1e6}


class ScpiError(Exception):
    """Something for the error queue."""

    def __init__(self, number: int) -> None:
        super().__init__(f'{number:+d},"{MESSAGES[number]}"')
        self.number = number


@dataclass(frozen=True, kw_only=True)
class Unit:
    """One command or query of a message."""

    header: str
    """From the root, in capitals: `SENS:VOLT:NPLC`, `*IDN?`."""
    parameters: tuple[str, ...]


class Tree(Generic[Entry]):
    """Finds entries by any spelling of their header.

    A header is written as in a manual: `[SENSe]:VOLTage[:DC]:NPLC`. Nodes in brackets may be left out, and of each node
    the capitals alone, or the whole, must be given (SCPI-1999, volume 1, 6.2.1 and 6.2.3).
    """

    def __init__(self, entries: Mapping[str, Entry]) -> None:
        self._entries = {spelling: entry for header, entry in entries.items() for spelling in spellings(header)}

    def find(self, header: str) -> Entry:
        """The entry of a header in capitals, from the root. Raises `ScpiError` -113."""
        try:
            return self._entries[header]
        except KeyError:
            raise ScpiError(-113) from None


def spellings(header: str) -> Iterator[str]:
    """Every way in which a header may be written, in capitals."""
    if header.startswith("*"):
        yield header
        return
    choices = []
    mark = "?" if header.endswith("?") else ""
    for opening, short, rest, suffix in _NODE.findall(header):
        forms = dict.fromkeys((short + suffix, short + rest.upper() + suffix))
        choices.append([*forms, ""] if opening else [*forms])
    for nodes in product(*choices):
        yield ":".join(node for node in nodes if node) + mark


def units(message: str) -> Iterator[Unit]:
    """Take a message apart. Raises `ScpiError` when it comes to something that cannot be understood.

    A header without a colon before it goes on where the one before it ended; common commands leave that path as it is
    (SCPI-1999, volume 1, 6.2.4).
    """
    path = ""
    for text in split(message, ";"):
        if not text.strip():
            continue
        found = _UNIT.fullmatch(text)
        if found is None:
            raise ScpiError(-102)
        header = found["header"].upper()
        if not header.startswith("*"):
            header = header[1:] if header.startswith(":") else path + header
            path = header[: header.rfind(":") + 1]
        parameters = split(found["parameters"], ",") if found["parameters"] else []
        yield Unit(header=header, parameters=tuple(parameter.strip() for parameter in parameters))


def split(text: str, separator: str) -> list[str]:
    """Divide at separators outside quotation marks and parentheses. Raises `ScpiError` for an open quotation."""
    if not _ENCLOSING.intersection(text):
        return text.split(separator)
    parts, begin, quote, depth = [], 0, "", 0
    for place, character in enumerate(text):
        if quote:
            quote = "" if character == quote else quote
        elif character in "\"'":
            quote = character
        elif character in "()":
            depth += 1 if character == "(" else -1
        elif character == separator and depth <= 0:
            parts.append(text[begin:place])
            begin = place + 1
    if quote:
        raise ScpiError(-151)
    return [*parts, text[begin:]]


def number(text: str, unit: str = "") -> float:
    """Read a number in a unit, with or without its suffix: `0.1`, `100 mV`, `1e-1 V`.

    Raises `ScpiError` where it is none, or has a suffix of another unit.
    """
    found = _NUMBER.fullmatch(text.upper())
    if found is None:
        raise ScpiError(-121)
    digits, suffix = found.groups()
    if suffix and not unit:
        raise ScpiError(-138)
    prefix = suffix.removesuffix(unit.upper()) if suffix else ""
    if (suffix and not suffix.endswith(unit.upper())) or prefix not in _PREFIXES:
        raise ScpiError(-131)
    return float("".join(digits.split())) * _PREFIXES[prefix]


def word(text: str, choices: tuple[str, ...]) -> str:
    """The choice, written as in a manual (`IMMediate`), that a word means: its capitals, as in an answer.

    Raises `ScpiError` where it means none of them.
    """
    for choice in choices:
        if text.upper() in spellings(choice):
            return "".join(character for character in choice if not character.islower())
    raise ScpiError(-224)


def quoted(text: str) -> str:
    """What stands between quotation marks. Raises `ScpiError` where there are none."""
    if len(text) < 2 or text[0] != text[-1] or text[0] not in "\"'":
        raise ScpiError(-151)
    return text[1:-1]
