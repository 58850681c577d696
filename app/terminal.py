"""The one way to standard output and standard error: text is shown as it is, and never commands a terminal.

Messages are put into the language that was asked for; documents stay in English.
"""

import io
import os
import sys
from contextlib import suppress
from dataclasses import dataclass
from typing import IO, Any, Final, TextIO

import click

from tumble.drivers.text import visible
from tumble.messages import Language, Message
from tumble.numerals import in_words_of

LONGEST_LINE: Final = 20_000
"""Characters of a line that is shown."""
LONGEST_COMPLAINT: Final = 2_000
"""Characters of what is said of an error, which may echo a file."""


@dataclass
class _Speech:
    """The language of the terminal."""

    language: Language = Language.ENGLISH


_SPEECH: Final = _Speech()


def speak(language: Language) -> None:
    """Have messages said in a language from now on."""
    _SPEECH.language = language


def language() -> Language:
    """The language that is spoken."""
    return _SPEECH.language


def shown(text: str, most: int = LONGEST_LINE) -> str:
    """Text as it may be put on a terminal: in the language that is spoken, what cannot be seen as an escape.

    A message is put into the language with its numbers and units; any other text stays as it is.

    Parameters
    ----------
    text
        A message, or any other text.
    most
        Characters, of which the middle gives way.
    """
    spoken = _SPEECH.language
    return visible(in_words_of(text, spoken) if isinstance(text, Message) else text, most)


def say(*lines: str, err: bool = False, most: int = LONGEST_LINE) -> None:
    """Print lines of text; what cannot be seen is printed as an escape, whatever the text comes from."""
    write("".join(f"{shown(line, most)}\n" for line in lines), sys.stderr if err else sys.stdout)


def numeric(text: str) -> Message:
    """Numbers and units as a message, so that they are written as the language that is spoken writes them."""
    return text if isinstance(text, Message) else Message("{text}", text=text)


def labelled(label: str, text: object, width: int = 10) -> Message:
    """A line of which the text stands in a column, after a label of at most `width` characters."""
    return Message("{label:{width}} {text}", label=label, width=width, text=text)


def say_document(document: dict[str, Any]) -> None:
    """Print a document as JSON on standard output."""
    write(as_json(document), sys.stdout)


def as_json(document: dict[str, Any]) -> str:
    """Text of a document as JSON, in which every character that cannot be seen is escaped."""
    import json  # not of `tumble --help`

    text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
    return "\n".join(map(_escaped, text.split("\n"))) + "\n"


def write(text: str, stream: TextIO) -> None:
    """Write text as it is. Whoever reads may leave early: the rest goes nowhere, and the command ends as it would have.

    Raises `OSError`: a file into which a stream was redirected may lie on a full disk.
    """
    try:
        click.echo(text, nl=False, file=stream)
    except BrokenPipeError:
        lead_nowhere(stream)


def flush(stream: TextIO) -> None:
    """Write what is still to be written, as `write`."""
    try:
        stream.flush()
    except BrokenPipeError:
        lead_nowhere(stream)


def lead_nowhere(stream: IO[str]) -> None:
    """Have everything that is still to be written into a stream be lost without an error."""
    with suppress(OSError, ValueError):  # it is no file
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def prepare_streams() -> None:
    """Write UTF-8 into files and pipes: not every system has a sign for arc seconds, and JSON is nothing else.

    What a terminal has no sign for becomes an escape; a stream that was closed before the program began leads nowhere.
    """
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115, PTH123  # for good
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding=None if stream.isatty() else "utf-8", errors="backslashreplace")


def _escaped(line: str) -> str:
    r"""A line of JSON with escapes as JSON has them: `\\u` and four digits, a pair of them beyond U+FFFF."""
    return line if visible(line) == line else "".join(map(_escaped_character, line))


def _escaped_character(character: str) -> str:
    import json

    return character if visible(character) == character else json.dumps(character)[1:-1]
