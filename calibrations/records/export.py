"""A record as one JSON document, `tumble.record/3`, that carries its own hash."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.records.canonical import canonical_sha256, canonical_text, plain
from tumble.calibrations.records.record import JUDGED_SINCE, OLD_WORDS, Record
from tumble.calibrations.records.times import utc_text


def document(record: Record) -> dict[str, Any]:
    """Everything that the record says, with `content_sha256`: the hash of the canonical text of all other keys."""
    return content(record) | {"content_sha256": record.content_sha256}


def document_text(record: Record) -> str:
    """Return the document in canonical spelling (`canonical.canonical_text`), with a line end."""
    return canonical_text(document(record)) + "\n"


def is_intact(document: Mapping[str, Any]) -> bool:
    """Whether the document is what was recorded."""
    rest = {key: value for key, value in document.items() if key != "content_sha256"}
    return bool(document.get("content_sha256") == canonical_sha256(rest))


def content(record: Record) -> dict[str, Any]:
    """The document without its hash."""
    return {
        "schema": f"tumble.record/{record.format_version}",
        "id": record.id,
        "revision": record.revision,
        "supersedes": record.supersedes,
        "created_at": utc_text(record.created_at),
        "verdict": record.verdict.as_json() if record.format_version >= JUDGED_SINCE else spelling(record),
        "limits": [flat(check) for check in record.limits],
        "provenance": flat(record.provenance),
        "result": plain(record.result),
    }


def spelling(record: Record) -> str:
    """The outcome in one word, as records of its format spell it."""
    outcome = record.verdict.outcome
    return str(outcome) if record.format_version >= JUDGED_SINCE else OLD_WORDS[outcome]


def flat(data: Provenance | LimitCheck) -> dict[str, Any]:
    """The fields of a dataclass as JSON has them."""
    return plain({field.name: getattr(data, field.name) for field in fields(data)})
