"""Text from outside: what a file, an instrument or a person wrote, before it is shown or taken for a name."""

import re
from typing import Final

from tumble.messages import Message

LONGEST_NAME: Final = 100
"""Characters of a serial number or a name that a person can still read."""

_LONGEST_REASON: Final = 300
"""Characters of what somebody else's code says of an error."""
_UNSEEN: Final = re.compile(
    "["
    "\x00-\x1f\x7f-\x9f"  # control characters, the escape that commands a terminal among them
    "\u061c\u200b\u200e\u200f\u2060\u2028-\u202e\u2066-\u2069\ufeff\ufff9-\ufffb"  # line and direction of writing
    "\ud800-\udfff"  # halves of a pair, which stand for bytes that are no text
    "\U000e0000-\U000e007f"  # tags
    "]"
)
"""What shows nothing, or shows other text differently: Unicode Standard, chapter 23, and Technical Report 36."""


def visible(text: str, most: int | None = None) -> str:
    r"""Text on one line as it may be put on a terminal: what cannot be seen as an escape (`\x1b`, `\u202e`).

    Parameters
    ----------
    text
        Whatever it is.
    most
        Characters, of which the middle gives way; all without it.
    """
    shown = _UNSEEN.sub(_escape, _shortened(text, most))
    return _shortened(shown, most)


def reason_of(error: BaseException) -> str:
    """Kind and text of an error that somebody else's code raised, on one line of bearable length."""
    try:
        text = str(error)
    except Exception:
        text = "it cannot say why"
    return visible(f"{type(error).__name__}: {text}", _LONGEST_REASON)


def _shortened(text: str, most: int | None) -> str:
    if most is None or len(text) <= most:
        return text
    ending = most // 3
    return f"{text[: most - ending]} … {text[-ending:]}"


def check_name(text: str) -> str:
    """Give `text` back where it can serve as a name. Raises `ValueError` with what is wrong with it."""
    if len(text) > LONGEST_NAME:
        raise ValueError(
            Message(
                "{length} characters are no name; give {most} at most",
                length=len(text),
                most=LONGEST_NAME,
            )
        )
    if found := _UNSEEN.search(text):
        raise ValueError(
            Message(
                "{found} at character {place} cannot be seen; give plain text",
                found=_escape(found),
                place=found.start() + 1,
            )
        )
    return text


def _escape(found: re.Match[str]) -> str:
    number = ord(found[0])
    if number < 0x100:
        return f"\\x{number:02x}"
    return f"\\u{number:04x}" if number < 0x10000 else f"\\U{number:08x}"
