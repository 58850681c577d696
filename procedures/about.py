"""What a programme says of itself: the comment at the beginning of its file.

That of a programme that comes along is a key of the catalogue; `pyproject.toml` names `extracted` as what collects it.
"""

from collections.abc import Collection, Iterator, Mapping
from itertools import takewhile
from typing import IO, Any

from tumble.procedures.toml_text import BYTE_ORDER_MARK


def about(text: str) -> str:
    """The comment that a programme (TOML) begins with, on one line; empty where there is none."""
    lines = (line.strip() for line in text.removeprefix(BYTE_ORDER_MARK).strip().splitlines())
    return " ".join(line.lstrip("# ") for line in takewhile(lambda line: line.startswith("#"), lines)).strip()


def extracted(
    file: IO[bytes],
    keywords: Mapping[str, Any],  # noqa: ARG001  # Babel gives these by name, too
    comment_tags: Collection[str],  # noqa: ARG001
    options: Mapping[str, Any],  # noqa: ARG001
) -> Iterator[tuple[int, None, str, list[str]]]:
    """The key of a programme's file, as Babel asks for it: line, function, text, comments."""
    if said := about(file.read().decode("utf-8")):
        yield 1, None, said, []
