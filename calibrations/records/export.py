"""A record as one JSON document, `tumble.record/5`, that carries its own hash."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.records.canonical import canonical_sha256, canonical_text, plain
from tumble.calibrations.records.old_formats import JUDGED_SINCE, LOTS_SINCE, METHODS_SINCE, OLD_WORDS, joined
from tumble.calibrations.records.record import Record
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
        "limits": [flat(check) for check in record.limits],
        "result": plain(record.result),
        **(_of_any_method(record) if record.format_version >= METHODS_SINCE else _of_old_format(record)),
    }


def _of_any_method(record: Record) -> dict[str, Any]:
    return {
        "method": record.method,
        "method_version": record.method_version,
        **(asdict(record.link) if record.link else {}),
        "verdict": record.verdict.as_json(),
        "provenance": _provenance(record),
        "parameters": plain(record.models_json or {}),
    }


def _of_old_format(record: Record) -> dict[str, Any]:
    """What is spelt in another way up to format 3."""
    provenance = _provenance(record)
    del provenance["sources"]
    verdict = record.verdict
    return {
        "verdict": verdict.as_json() if record.format_version >= JUDGED_SINCE else OLD_WORDS[verdict.outcome],
        "provenance": provenance | joined(record.provenance.sources),
    }


def _provenance(record: Record) -> dict[str, Any]:
    provenance = flat(record.provenance)
    if record.format_version < LOTS_SINCE:
        del provenance["lot"]
    return provenance


def flat(data: Provenance | LimitCheck) -> dict[str, Any]:
    """The fields of a dataclass as JSON has them."""
    return plain(asdict(data))
