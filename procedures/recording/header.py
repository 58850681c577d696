"""What a recording says of itself before the first point."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, dataclass, fields
from typing import Any

from tumble.messages import Message
from tumble.procedures.first_method import FIRST

FORMAT_VERSION = 3
"""1 had neither `job` nor the identification of instruments, nor runs that were resumed; 2 had no checksum of its
header, and none of its data as a whole. All of them are read."""
NEWEST_VERSION = 4
"""Written for every method but the first: version 0.1, which knows no other, then says that it cannot read the file."""
PROTECTED_SINCE = 3
"""From this version on damage to a header is noticed."""
_SHA256 = "header_sha256"


@dataclass(frozen=True, kw_only=True)
class Header:
    """Everything needed to know how a recording came about and to go on with it.

    Raises
    ------
    ValueError
        Where `stand` still has its `simulated` table: what is simulated never reaches a recording.
    """

    serial_number: str
    """Serial number of the unit under test."""
    operator: str
    programme_text: str
    """The programme as it was read, TOML."""
    programme_sha256: str
    stand: Mapping[str, Any]
    """The stand file as data, without its `simulated` table."""
    stand_path: str
    """Where the stand file lay; empty for the built-in stand."""
    stand_sha256: str
    """Of the whole stand file, `simulated` table included."""
    program_version: str
    git_commit: str
    """Commit of the running program; empty where it runs outside a checkout."""
    git_dirty: bool
    packages: Mapping[str, str]
    """Version of every package that took part, by name."""
    started_wall_ns: int
    """Nanoseconds since 1970-01-01 UTC."""
    started_monotonic_s: float
    """The stand's monotonic clock at the same moment."""
    job: str = "run"
    """What was asked for: `run`, or `calibrate` where a fit, a record and a report shall follow."""
    follows: Sequence[str] = ()
    """Recordings that were made before on the same connection, in their order."""
    stand_code_sha256: Mapping[str, str] | None = None
    """SHA-256 of every Python file that the stand file names, by `FILE.py:NAME`; None where that was not recorded."""
    method: str = FIRST
    """Name of the method whose points these are."""
    method_version: int = 1
    lot: str = ""
    """In which the unit was made; empty where nobody said so."""
    format_version: int = FORMAT_VERSION

    @property
    def protected(self) -> bool:
        """Whether damage to it would have been noticed."""
        return self.format_version >= PROTECTED_SINCE

    @property
    def has_its_programme(self) -> bool:
        """Whether the programme is the one that was begun, by its hash."""
        return hashlib.sha256(self.programme_text.encode()).hexdigest() == self.programme_sha256

    def __post_init__(self) -> None:
        object.__setattr__(self, "follows", tuple(self.follows))  # a list in a recording
        if "simulated" in self.stand:
            raise ValueError(Message("the stand in a recording's header must be without its [simulated] table"))


def written_version(method: str) -> int:
    """The oldest format that holds runs of a method, so that the program of then reads what it can."""
    return FORMAT_VERSION if method == FIRST else NEWEST_VERSION


def header_to_strings(header: Header) -> dict[str, str]:
    """Give every field but `programme_text` as a string, the way an MCAP metadata record wants it, and their hash.

    What is not a string is written as JSON, dates and times inside the stand file as ISO 8601 strings.
    """
    values = {field.name: getattr(header, field.name) for field in fields(Header) if field.name != "programme_text"}
    strings = {name: value if isinstance(value, str) else _to_json(value) for name, value in values.items()}
    return strings | {_SHA256: _sha256(strings, header.programme_text)}


def is_intact(strings: Mapping[str, str], programme_text: str) -> bool:
    """Whether strings and programme are those that `header_to_strings` gave; true where they are older than the hash.

    The hash is that of the JSON of the strings, sorted by name, and the programme. It protects against damage, not
    against somebody who reckons it anew.
    """
    rest = {name: text for name, text in strings.items() if name != _SHA256}
    if _SHA256 not in strings:
        return int(strings.get("format_version", FORMAT_VERSION)) < PROTECTED_SINCE
    return strings[_SHA256] == _sha256(rest, programme_text)


def _sha256(strings: Mapping[str, str], programme_text: str) -> str:
    return hashlib.sha256(json.dumps([sorted(strings.items()), programme_text]).encode()).hexdigest()


def header_from_strings(strings: Mapping[str, str], programme_text: str) -> Header:
    """Build the header from what `header_to_strings` gave; strings that it does not know are left out.

    Raises
    ------
    KeyError, ValueError
        Where a field is missing or is not what it should be.
    """
    values: dict[str, Any] = {
        field.name: strings[field.name] if field.type is str else json.loads(strings[field.name])
        for field in fields(Header)
        if field.name in strings or (field.default is MISSING and field.name != "programme_text")
    }
    return Header(programme_text=programme_text, **values)


def _to_json(value: object) -> str:
    return json.dumps(value, default=lambda moment: moment.isoformat())
