"""Messages to a SCPI instrument, and what may be believed of its answers.

An instrument that takes several queries in one message is talked to as follows; for one that does not, see `plain`.
SCPI has no checksum and no message number. Both are made here from what IEEE 488.2 gives to every instrument:

- **Number.** `*ESE` stores a number from 0 to 255 and gives it back (IEEE 488.2-1992, 10.10 and 10.11); the register
  only serves service requests, which nobody uses on a serial line or a socket. So every message sets it to the number
  of the request, and asks for it before and behind everything else: `*ESE 7;*ESE?;:FETC?;:FETC?;*ESE?`.
- **Redundancy.** Whatever is asked is asked twice in one message, unless asking changes it (`SYST:ERR?`). Answers to
  one message come in one line, separated by semicolons (IEEE 488.2-1992, 8.4): `+7;+2.5E+00;+2.5E+00;+7`.

A line is believed when both numbers are those of the request and both copies are equal, character by character. This
detects answers that are cut, late, doubled, out of order or merged, and any garbling except one that changes both
copies in the same way. What the instrument itself gets wrong before it writes the line, nothing here can detect; that a
command arrived as meant is seen only by asking for the setting again, which the driver does.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.drivers.protocols import Identity
from tumble.messages import Message

TERMINATOR = b"\n"
TAGS = 256
"""How many numbers a request can have."""
NOT_A_NUMBER = 9.91e37
"""How SCPI instruments write NaN (SCPI-1999, volume 1, 7.2.1.5)."""

_FIELD = re.compile(r'(?:^|;)((?:[^;"]+|"[^"]*")*)')
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[Ee][+-]?\d{1,3})?"
_READING = rf"(?:{_NUMBER}|NAN|INF|NINF)"
_INTEGER = re.compile(r"[+-]?\d{1,9}", re.ASCII)
_READINGS = re.compile(rf"{_READING}(?:,{_READING})*", re.ASCII)
_ERROR = re.compile(r"""([+-]?\d{1,5}) *, *(?:"([^"]*)"|([^",]+))""", re.ASCII)
_ALL_WELL = "no error"
_WORDS = {"NAN": "nan", "INF": "9.9e37", "NINF": "-9.9e37"}


class CorruptReplyError(ValueError):
    """An answer that cannot be believed."""


class StaleReplyError(ValueError):
    """A whole answer to an earlier request."""


@dataclass(frozen=True, kw_only=True)
class QueueEntry:
    """An entry of the error queue; number 0 says that the queue is empty (SCPI-1999, volume 2, 21.8)."""

    number: int
    text: str

    def __str__(self) -> str:
        return f'{self.number},"{self.text}"'


def request(tag: int, commands: Sequence[str], queries: Sequence[str]) -> bytes:
    """Write commands, then queries, as one message with the number `tag`.

    Headers are taken from the root; none of the queries may be `*IDN?` or `*OPT?`, which must come last.
    """
    units = [f"*ESE {tag}", *map(rooted, commands), "*ESE?", *map(rooted, queries), "*ESE?"]
    return ";".join(units).encode("ascii") + TERMINATOR


def rooted(unit: str) -> str:
    """The header from the root, so that it does not depend on the one before it (SCPI-1999, volume 1, 6.2.4)."""
    return unit if unit.startswith(("*", ":")) else f":{unit}"


def parse_reply(line: bytes, tag: int, queries: int) -> tuple[str, ...]:
    """Take the answers to `queries` queries out of the line that answers request number `tag`.

    Raises
    ------
    StaleReplyError
        The line answers another request.
    CorruptReplyError
        The line is not what any request is answered with.
    """
    first, *answers, last = _fields(line, at_least=2)
    if parse_integer(first) != parse_integer(last):
        raise CorruptReplyError(Message("begin and end of the line belong to different requests"))
    if parse_integer(first) != tag:
        raise StaleReplyError(Message("answer number {first} instead of {tag}", first=first, tag=tag))
    if len(answers) != queries:
        raise CorruptReplyError(
            Message.counted(
                "{count} answer to {queries} questions",
                "{count} answers to {queries} questions",
                count=len(answers),
                queries=queries,
            )
        )
    return tuple(answers)


def agreed(answers: Sequence[str]) -> tuple[str, ...]:
    """The first half of answers to queries that were asked twice. Raises `CorruptReplyError` if the second differs."""
    half = len(answers) // 2
    if tuple(answers[:half]) != tuple(answers[half:]):
        raise CorruptReplyError(Message("two copies of the same answer differ"))
    return tuple(answers[:half])


def identity_request(tag: int) -> bytes:
    """Ask who the instrument is; the answer to `*IDN?` must be the last of its line (IEEE 488.2-1992, 10.14)."""
    return f"*ESE {tag};*ESE?;*IDN?".encode("ascii") + TERMINATOR


def parse_identity(line: bytes, tag: int) -> Identity:
    """Read the answer to `identity_request`: maker, model, serial number, firmware, separated by commas.

    Its text is not protected: ask until two answers agree. Raises as `parse_reply`.
    """
    first, name = _fields(line, at_least=2, at_most=2)
    if parse_integer(first) != tag:
        raise StaleReplyError(Message("answer number {first} instead of {tag}", first=first, tag=tag))
    return parse_name(name)


def parse_name(name: str) -> Identity:
    """Read the answer to `*IDN?` alone. Raises `CorruptReplyError`."""
    parts = [part.strip() for part in name.split(",", 3)]
    if len(parts) != 4 or not all(parts[:3]):
        raise CorruptReplyError(Message("{name!r} is not maker, model, serial number and firmware", name=name))
    maker, model, serial, firmware = parts
    return Identity(model=f"{maker} {model}", serial=serial, firmware=firmware)


def parse_line(line: bytes) -> str:
    """The one answer in a line. Raises `CorruptReplyError` where it is no text, or none."""
    text = line.strip(b"\r\n ")
    if not text or not all(0x20 <= octet < 0x7F for octet in text):
        raise CorruptReplyError(Message("{line!r} is no answer in plain text", line=line[:40]))
    return text.decode("ascii")


def parse_readings(field: str) -> NDArray[np.float64]:
    """Read numbers separated by commas; overloads stay ±9.9e37, what means NaN becomes NaN.

    Raises `CorruptReplyError` where anything is not a number of IEEE 488.2-1992, 8.7.
    """
    if not _READINGS.fullmatch(field):
        raise CorruptReplyError(Message("{field!r} is not a list of numbers", field=field[:40]))
    tokens = [_WORDS.get(token, token) for token in field.split(",")]
    values = np.array(tokens, dtype=np.float64)
    values[values == NOT_A_NUMBER] = np.nan
    return values


def parse_number(field: str) -> float:
    """Read one number. Raises `CorruptReplyError` where it is not exactly one."""
    values = parse_readings(field)
    if len(values) != 1:
        raise CorruptReplyError(Message("{field!r} is not one number", field=field[:40]))
    return float(values[0])


def parse_error(field: str) -> QueueEntry:
    """Read an answer to `SYST:ERR?`, with or without quotation marks, and with whatever follows the text in them.

    It is asked once only, and therefore number and text must agree: 0 is `No error`, and nothing else is.
    Raises `CorruptReplyError`.
    """
    found = _ERROR.fullmatch(field)
    if found is None:
        raise CorruptReplyError(Message("{field!r} is not an entry of an error queue", field=field[:40]))
    entry = QueueEntry(number=int(found[1]), text=found[2] if found[3] is None else found[3].strip())
    if (entry.number == 0) != entry.text.casefold().startswith(_ALL_WELL):
        raise CorruptReplyError(
            Message("{field!r} has a number and a text that do not belong together", field=field[:40])
        )
    return entry


def _fields(line: bytes, *, at_least: int, at_most: int | None = None) -> list[str]:
    """Answers in a line, separated by semicolons outside quotation marks."""
    try:
        text = line.decode("ascii").rstrip("\r\n")
    except UnicodeDecodeError:
        raise CorruptReplyError(Message("a character that is not ASCII")) from None
    fields: list[str] = _FIELD.findall(text)
    if ";".join(fields) != text:
        raise CorruptReplyError(Message("a quotation mark without its other half"))
    if not at_least <= len(fields) <= (at_most or len(fields)):
        raise CorruptReplyError(
            Message.counted("{count} answer in a line", "{count} answers in a line", count=len(fields))
        )
    return fields


def parse_integer(field: str) -> int:
    """Read the number of a request. Raises `CorruptReplyError`."""
    if not _INTEGER.fullmatch(field):
        raise CorruptReplyError(Message("{field!r} is not the number of a request", field=field[:20]))
    return int(field)
