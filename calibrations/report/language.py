"""The language in which a page is written, while it is written."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, Final

from jinja2 import pass_context
from jinja2.runtime import Context

from tumble.messages import Language, Message
from tumble.numerals import localised

_WRITTEN: Final[ContextVar[Language]] = ContextVar("_WRITTEN", default=Language.ENGLISH)


@contextmanager
def written_in(language: Language) -> Iterator[None]:
    """Have every template and every figure that is made meanwhile put what it says into a language."""
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
    return localised(text.in_language(language()) if isinstance(text, Message) else text, language())


@pass_context  # so that no template keeps what it said in the language of another page
def finalized(_context: Context, value: Any) -> Any:  # noqa: ANN401  # whatever a template writes
    """What a template writes: text in the language of the page, markup as it is."""
    if hasattr(value, "__html__") or not isinstance(value, str | float):
        return value
    return say(str(value))
