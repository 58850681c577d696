"""The language in which a page is written, while it is written."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Final

from tumble.messages import AsWritten, Language, Message
from tumble.numerals import localised

_ARCSEC: Final = re.compile(r"(?:(?<=\d)|(?<=\(\d\d\))) arcsec\b|\barcsec\b")
_WRITTEN: Final[ContextVar[Language]] = ContextVar("_WRITTEN", default=Language.ENGLISH)


@contextmanager
def written_in(language: Language) -> Iterator[None]:
    """Have every report and every figure that is made meanwhile put what it says into a language."""
    token = _WRITTEN.set(language)
    try:
        yield
    finally:
        _WRITTEN.reset(token)


def language() -> Language:
    """The language of the page that is written; English outside of one."""
    return _WRITTEN.get()


def say(text: str) -> str:
    """A message or text in the language of the page that is written, numbers, units and names of effects included.

    A document, and the terminal in English, have `head_scale`; a reader of the page has words for it.
    """
    if not isinstance(text, Message):
        return _signed(localised(text, language())) if not isinstance(text, AsWritten) else text
    return _signed(localised(text.worded(language()), language(), text.as_written()))


def _signed(text: str) -> str:
    """The text with ″ for arc seconds, which some terminals lack (SI brochure, table 8)."""
    return _ARCSEC.sub("″", text)
