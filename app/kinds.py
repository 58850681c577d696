"""Kinds of results, each known by how its files begin."""

import re
from enum import StrEnum
from pathlib import Path
from typing import Final

from tumble.messages import Message

BEGINNING_BYTES: Final = 4096
"""So much of a file says what it is."""


class Kind(StrEnum):
    """What a command or the window writes."""

    RESULT = "result (JSON)"
    RECORD = "record (JSON)"
    EFFECT = "adopted effect (JSON)"
    REPORT = "report (HTML)"
    TABLE = "table of a recording (CSV)"
    PDF = "report (PDF)"

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return _WORDS[self]


_WORDS: Final = {
    Kind.RESULT: Message("result (JSON)"),
    Kind.RECORD: Message("record (JSON)"),
    Kind.EFFECT: Message("adopted effect (JSON)"),
    Kind.REPORT: Message("report (HTML)"),
    Kind.TABLE: Message("table of a recording (CSV)"),
    Kind.PDF: Message("report (PDF)"),
}


_PAGE: Final = (
    rb'<!DOCTYPE html>\n<html lang="(?:en|uk|de)">\n<head>\n<meta charset="utf-8">\n'
    rb'(<meta name="generator" content="tumble">\n'
    rb'|<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>Calibration of )'  # of version 0.1
)
_KEYWORD: Final = b"/Keywords(tumble)"
"""In a PDF; those of version 0.2 and before name their creator at the beginning."""
_CREATOR: Final = re.escape("tumble".encode("utf-16-be"))
_BEGINNINGS: Final = {
    Kind.RECORD: rb'\{"content_sha256":"[0-9a-f]{64}"|\{\s*"schema":\s*"tumble\.record/',
    Kind.EFFECT: rb'\{\s*"schema":\s*"tumble\.(?:adopted|retired)-effect/',
    Kind.RESULT: rb'\{\s*"schema":\s*"tumble\.[a-z-]+/\d',
    Kind.REPORT: _PAGE,
    Kind.PDF: rb"%PDF-.{,1000}/Creator \(\xfe\xff" + _CREATOR + rb"\)",
}
"""Of two that fit, the first counts."""


def report_kind(path: Path) -> Kind:
    """As what a report is written there, by the name of the file."""
    return Kind.PDF if path.suffix.lower() == ".pdf" else Kind.REPORT


def kind_of(beginning: bytes) -> Kind | None:
    """Which result it is that begins so; None for anything else."""
    for kind, pattern in _BEGINNINGS.items():
        if re.match(pattern, beginning, re.DOTALL):
            return kind
    return Kind.TABLE if _exported(beginning) else None


def kind_of_file(path: Path) -> Kind | None:
    """The same of a file; a PDF says at its end whose it is."""
    with path.open("rb") as file:
        beginning = file.read(BEGINNING_BYTES)
        if beginning.startswith(b"%PDF-") and _KEYWORD in beginning + file.read():
            return Kind.PDF
    return kind_of(beginning)


def _exported(beginning: bytes) -> bool:
    """Whether a table has all columns that a recording gives, in its order, and none besides."""
    from tumble.procedures.registry import usable_methods  # what is no table need not wait for every method

    line, end, _ = beginning.partition(b"\n")
    columns = line.decode("utf-8", "replace").split(",")
    known = usable_methods() if end and len(columns) > 1 else ()
    return any(method.procedure_part.exports(columns) for method in known)
