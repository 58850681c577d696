"""Messages: text in English made of a template and fields, which is put into another language where it is shown.

The template is the key under which `locales/<language>/LC_MESSAGES/tumble.po` holds its translation. English is the
source: what a catalogue does not hold stays in English, so that nothing is ever lost. This module imports nothing of
the product, and everything may import it.
"""

import gettext
from collections.abc import Iterable, Mapping
from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import Final, Self

_COLON: Final = ": "
_LOCALES: Final = Path(__file__).resolve().parent / "locales"


class Language(StrEnum):
    """A language that the product speaks."""

    ENGLISH = "en"
    UKRAINIAN = "uk"
    GERMAN = "de"

    @property
    def endonym(self) -> str:
        """What it calls itself."""
        return {"en": "English", "uk": "Українська", "de": "Deutsch"}[self]


class Message(str):
    """Text in English that keeps its template and its fields, to be put into another language.

    `Message("{rows} rows are too few", rows=3)` is the string `3 rows are too few`. The template is written as for
    `str.format`, its fields named; a field that is a message itself, or an exception that was given one, is put into
    the language with the whole. Of an exception only what it says is kept.
    """

    template: str
    plural: str
    """The template for more than one; empty where number makes no difference."""
    fields: Mapping[str, object]

    def __new__(cls, template: str, /, **fields: object) -> Self:
        """A message; `KeyError` where the template names a field that is not given."""
        return cls.of_parts(template, "", fields)

    @classmethod
    def counted(cls, singular: str, plural: str, /, *, count: int, **fields: object) -> Self:
        """A message whose wording depends on a number, which is its field `count`."""
        return cls.of_parts(singular, plural, {"count": count, **fields})

    @classmethod
    def marked(cls, template: str, /, **fields: object) -> Self:
        """A message of a template out of a table, where `translatable` has marked it for the catalogue."""
        return cls.of_parts(template, "", fields)

    @classmethod
    def joined(cls, separator: str, parts: Iterable[str]) -> Self:
        """Several messages or texts as one, each put into the language by itself."""
        fields = {f"part{place}": part for place, part in enumerate(parts)}
        return cls(separator.join(f"{{{name}}}" for name in fields), **fields)

    @classmethod
    def named(cls, name: str, wording: str, /, **fields: object) -> Self:
        """A name of a document, which a reader is shown in words: the template `wording`, with its fields.

        The string is the name itself, so that it compares, sorts and is written as that.
        """
        _NAMED[name] = made = cls._spelt(name, wording, "", fields)
        return made

    @classmethod
    def capitalised(cls, part: str, /) -> "Message":
        """A message or text with a capital at its beginning, in whatever language it is put."""
        return _Capitalised._spelt(_with_capital(part), "{part}", "", {"part": part})

    @classmethod
    def of_parts(cls, template: str, plural: str, fields: Mapping[str, object]) -> Self:
        """A message of the parts that it keeps; its `plural` is empty where number makes no difference."""
        fields = {name: str(value) if isinstance(value, Exception) else value for name, value in fields.items()}
        chosen = plural if plural and fields["count"] != 1 else template
        return cls._spelt(chosen.format(**fields), template, plural, fields)

    @classmethod
    def _spelt(cls, text: str, template: str, plural: str, fields: Mapping[str, object]) -> Self:
        made = super().__new__(cls, text)
        made.template, made.plural, made.fields = template, plural, fields
        return made

    def __str__(self) -> Self:
        """Itself, so that the text of an exception that a message was given to is that message still."""
        return self

    def in_language(self, language: Language) -> str:
        """The text in a language; in English, and where the catalogue lacks the template, as it is."""
        return self[:] if language is Language.ENGLISH else self.worded(language)

    def worded(self, language: Language) -> str:
        """The same, but in English too names of a document in their wordings, those in fields included."""
        if self.plural:
            count = self.fields["count"]
            assert isinstance(count, int), "`counted` takes a whole number"
            template = _catalogue(language).ngettext(self.template, self.plural, count)
        else:
            template = _looked_up(self.template, language)
        return template.format(**{name: _worded(value, language) for name, value in self.fields.items()})

    def as_written(self) -> frozenset[str]:
        """The texts in its fields, and in those of its parts, that are the same in every language."""
        parts = (each.as_written() for each in self.fields.values() if isinstance(each, Message))
        return frozenset(each for each in self.fields.values() if isinstance(each, AsWritten) and each).union(*parts)

    def __reduce__(self) -> tuple[object, ...]:
        return _restored, (type(self), self[:], self.template, self.plural, dict(self.fields))


class AsWritten(str):
    """Text that is the same in every language: a version, a path, what a file says, the name of a unit."""

    __slots__ = ()


class _Capitalised(Message):
    """A message that begins with a capital."""

    def worded(self, language: Language) -> str:
        """The text in a language, with a capital at its beginning."""
        return _with_capital(super().worded(language))


class _ReadBack(Message):
    """A text of a document, which has lost of what it was joined."""

    def worded(self, language: Language) -> str:
        """The text in a language, as far as the catalogue has it."""
        whole = super().worded(language)
        parts = self.split(_COLON)
        return whole if whole != self else _COLON.join(_looked_up(part, language) for part in parts)


def translate(text: str, language: Language) -> str:
    """Text in a language: a message with its fields, any other as a key of the catalogue; English where unknown."""
    return text.in_language(language) if isinstance(text, Message) else _looked_up(text, language)


def with_wording(name: str) -> str:
    """The name of a document as `Message.named` declared it; any other text as it is.

    What comes out of an array or a document has lost its wording.
    """
    return _NAMED.get(name, name)


def read_back(text: str) -> str:
    """A text of a document, which a reader is shown as a key of the catalogue where it is one without fields.

    Where it is none, but was joined of such with colons, each of them is.
    """
    return text if "{" in text or "}" in text else _ReadBack.marked(text)


def translatable(template: str) -> str:
    """The template itself, marked for the catalogue; for tables of templates that are put into words later."""
    return template


def _worded(value: object, language: Language) -> object:
    return value.worded(language) if isinstance(value, Message) else value


def _with_capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _looked_up(template: str, language: Language) -> str:
    return _catalogue(language).gettext(template) if template else ""  # the empty key holds the catalogue's header


def _restored(kind: type[Message], text: str, template: str, plural: str, fields: Mapping[str, object]) -> Message:
    return kind._spelt(text, template, plural, fields)


_NAMED: Final[dict[str, Message]] = {}
"""Every name of a document that was given a wording."""


@cache
def _catalogue(language: Language) -> gettext.NullTranslations:
    return gettext.translation("tumble", _LOCALES, [language], fallback=True)
