"""The language in which a page is written, while it is written."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Final

from tumble.messages import Language, Message
from tumble.numerals import in_words_of, localised

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
    """A message or text in the language of the page, numbers and units included.

    In English it is the text itself: names of documents (`head_scale`) stay what they are on the terminal.
    """
    return in_words_of(text, language()) if isinstance(text, Message) else localised(text, language())
