"""Records as rows of the tables, and back."""

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.verdict import verdict_from_json
from tumble.calibrations.records.errors import StoreError
from tumble.calibrations.records.export import content
from tumble.calibrations.records.findings import text_of
from tumble.calibrations.records.old_formats import METHODS_SINCE, provenance_of, unsaid, verdict_of
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Link, Record
from tumble.calibrations.records.times import read_time, utc_text
from tumble.messages import Message

_FROM_PROVENANCE = (
    "serial_number",
    "operator",
    "programme_name",
    "programme_sha256",
    "stand_name",
    "program_version",
    "git_commit",
    "git_dirty",
)
_FROM_CONTENT = ("id", "revision", "supersedes", "created_at", "limits", "provenance", "result")
_NO_LINK = {"writer": None, "sequence": None, "previous_sha256": None}


def record_row(record: Record) -> dict[str, Any]:
    """The row of `records`."""
    document = content(record)
    measured_at = record.provenance.measured_at
    return {
        **{name: document[name] for name in _FROM_CONTENT},
        **{name: document["provenance"][name] for name in _FROM_PROVENANCE},
        **(asdict(record.link) if record.link else _NO_LINK),
        "method": record.method,
        "method_version": record.method_version,
        "sources": [asdict(source) for source in record.provenance.sources],
        "measured_at": utc_text(read_time(measured_at)) if measured_at else None,
        "format_version": record.format_version,
        "outcome": str(record.verdict.outcome),
        "verdict": record.verdict.as_json(),
        "complete": record.complete,
        "models": record.models_json,
        "lot": record.provenance.lot,
        "findings": text_of(record.result),
        "content_sha256": record.content_sha256,
    }


def parameter_rows(record: Record) -> list[dict[str, Any]]:
    """The rows of `parameters`."""
    return [
        _parameter_row(record.id, model, parameter)
        for model, parameters in record.models.items()
        for parameter in parameters.values()
    ]


def _parameter_row(record_id: str, model: str, parameter: RecordedParameter) -> dict[str, Any]:
    freedom, (lower_95, upper_95) = parameter.degrees_of_freedom, parameter.interval_95 or (None, None)
    return {
        "record_id": record_id,
        "model": model,
        "name": parameter.name,
        "unit": parameter.unit,
        "value": parameter.value,
        "standard_uncertainty": parameter.standard_uncertainty,
        "type_a": parameter.type_a,
        "degrees_of_freedom": None if freedom == float("inf") else freedom,
        "lower_95": lower_95,
        "upper_95": upper_95,
        "given": {given.name: given.value for given in parameter.given} or None,
        "reason": parameter.reason,
    }


def stored_record(row: Mapping[Any, Any], path: Path) -> Record:
    """Undo `record_row`; `path` is that of the store. Raises `StoreError` where the row is damaged."""
    try:
        record = _record(row)
        record.models  # noqa: B018  # up to format 3 these stand in the result, which may be any JSON
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError) as error:
        happened = Message(
            "record {id} is damaged ({error_type}: {error})",
            id=row["id"],
            error_type=type(error).__name__,
            error=error,
        )
        raise StoreError(path, happened, Message("restore the file from a backup")) from error
    return record


def _record(row: Mapping[str, Any]) -> Record:
    if not isinstance(row["result"], Mapping):
        raise TypeError(Message("its result is no object"))
    limits = tuple(LimitCheck(**check) for check in row["limits"])
    since = row["format_version"] >= METHODS_SINCE
    return Record(
        id=row["id"],
        format_version=row["format_version"],
        # What an old record does not say itself is not taken from a column that its hash does not cover.
        method=row["method"] if since else unsaid().method,
        method_version=row["method_version"] if since else unsaid().method_version,
        revision=row["revision"],
        supersedes=row["supersedes"],
        created_at=read_time(row["created_at"]),
        link=Link(**{name: row[name] for name in _NO_LINK}) if since else None,
        verdict=verdict_from_json(row["verdict"]) if since else verdict_of(row["result"], limits),
        limits=limits,
        provenance=provenance_of(row["provenance"]),
        models_json=row["models"] if since else None,
        result=row["result"],
        content_sha256=row["content_sha256"],
    )
