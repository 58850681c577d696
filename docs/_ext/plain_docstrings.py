"""Docstrings of this project are plain text with `code` in backticks; here they become reStructuredText."""

import re

from sphinx.application import Sphinx

CODE = re.compile(r"(``?[^`\n]+``?)")
"""Code in backticks, which is left alone."""
MARKUP = re.compile(r"([*|\\]|(?<=\w)_(?!\w))")
"""What reStructuredText would take for emphasis, substitution, escape or reference."""


def as_restructured_text(line: str) -> str:
    """One line, with `code` as a literal and nothing else taken for markup."""
    parts = CODE.split(line)
    parts[0::2] = [MARKUP.sub(r"\\\1", text) for text in parts[0::2]]
    parts[1::2] = [f"``{code.strip('`')}``" for code in parts[1::2]]
    return "".join(parts)


def convert(_app: Sphinx, _what: str, _name: str, _thing: object, _options: object, lines: list[str]) -> None:
    """Convert in place, before napoleon sees sections."""
    lines[:] = [as_restructured_text(line) for line in lines]


def setup(app: Sphinx) -> dict[str, bool]:
    """Convert every docstring before any other extension does."""
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("autodoc-process-docstring", convert, priority=1)
    return {"parallel_read_safe": True}
