"""Records as rows of the tables, and back."""

from collections.abc import Mapping
from typing import Any

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.records.export import content, spelling
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.times import read_time, utc_text

_FROM_PROVENANCE = (
    "serial_number",
    "operator",
    "programme_name",
    "programme_sha256",
    "stand_name",
    "raw_path",
    "raw_sha256",
    "program_version",
    "git_commit",
    "git_dirty",
)

_FROM_CONTENT = ("id", "revision", "supersedes", "created_at", "limits", "provenance", "result")


def record_row(record: Record) -> dict[str, Any]:
    """The row of `records`."""
    document = content(record)
    measured_at = record.provenance.measured_at
    return {
        **{name: document[name] for name in _FROM_CONTENT},
        **{name: document["provenance"][name] for name in _FROM_PROVENANCE},
        "measured_at": utc_text(read_time(measured_at)) if measured_at else None,
        "format_version": record.format_version,
        "verdict": spelling(record),
        "complete": record.complete,
        "content_sha256": record.content_sha256,
    }


def parameter_rows(record: Record) -> list[dict[str, Any]]:
    """The rows of `parameters`."""
    return [
        _parameter_row(record.id, model, parameter)
        for model, parameters in record.models.items()
        for parameter in parameters.values()
    ]


def _parameter_row(record_id: str, model: str, parameter: Parameter) -> dict[str, Any]:
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
        "given_alpha0_deg": parameter.given_alpha0_deg,
        "reason": parameter.reason,
    }


def record_from_row(row: Mapping[str, Any]) -> Record:
    """Undo `record_row`."""
    return Record(
        id=row["id"],
        format_version=row["format_version"],
        revision=row["revision"],
        supersedes=row["supersedes"],
        created_at=read_time(row["created_at"]),
        limits=tuple(LimitCheck(**check) for check in row["limits"]),
        provenance=Provenance(**row["provenance"]),
        result=row["result"],
        content_sha256=row["content_sha256"],
    )
