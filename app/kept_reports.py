"""What the report of a record says, kept in words beside it, so that it need not be worked out again.

A record never changes, and neither does what was found when it was made. What is kept counts as long as the record and
its raw files are the same; without it the report is worked out from the raw files.
"""

import gzip
import json
import zlib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tumble.app import reports
from tumble.app.exits import JobError
from tumble.app.files import replacing
from tumble.calibrations.core.sentences import series
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.raw import file_sha256
from tumble.calibrations.records.record import Record
from tumble.messages import Language, Message
from tumble.procedures.errors import InputError

if TYPE_CHECKING:
    from tumble.calibrations.core.parameter import Parameter
    from tumble.calibrations.records.store import Store
    from tumble.calibrations.report.document import Report

_SCHEMA: Final = "tumble.report-words/4"
"""Its number is raised whenever page or paper ask for other words."""
_VISIBLE: Final = 0.005
"""Of a standard uncertainty: no more than half a unit of the last of its two digits."""


def report_path(folder: Path, record: Record) -> Path:
    """Where the report of a record lies."""
    return folder / "reports" / f"{record.id}.html"


def of_record(report: "Report", record: Record, folder: Path) -> "Report":
    """With what has changed since the last calibration of the unit, and where its values are not the record's."""
    from tumble.app.last_calibration import changes_since

    told = report.with_changes(changes_since(folder, record))
    stated = report.front.parameters if report.front else {}
    other = [name for name, held in record.values.items() if name in stated and _differ(held, stated[name])]
    if not other:
        return told
    notice = Message(
        "The record holds other values of {names}: what stands here was worked out anew from its raw files.",
        names=series(other),
    )
    return replace(told, notices=(*told.notices, notice))


def _differ(held: RecordedParameter, stated: "Parameter") -> bool:
    """Whether the digits that the uncertainty supports are others."""
    if held.value is None or stated.value is None:
        return held.value is not stated.value
    return abs(held.value - stated.value) > _VISIBLE * (held.standard_uncertainty or 0.0)


def keep(report: "Report", record: Record, folder: Path) -> None:
    """Keep what it says in every language; where that cannot be written, it is worked out again next time."""
    content = {
        "schema": _SCHEMA,
        "record_sha256": record.content_sha256,
        "languages": {str(each): reports.in_words(report, each) for each in Language},
    }
    packed = gzip.compress(json.dumps(content, ensure_ascii=False).encode(), compresslevel=6, mtime=0)
    with suppress(InputError, JobError), replacing(_place(folder, record), None) as begun:
        begun.write_bytes(packed)


def kept(store: "Store", record: Record, language: Language) -> Mapping[str, Any] | None:
    """What it says in a language; None where nothing is kept, or record or raw files are not what they were."""
    try:
        content = json.loads(gzip.decompress(_place(store.folder, record).read_bytes()))
        hashes = tuple(file_sha256(path) for path in store.raw_files(record))
        of_record = (content["schema"], content["record_sha256"]) == (_SCHEMA, record.content_sha256)
        return dict(content["languages"][language]) if of_record and hashes == record.provenance.source_hashes else None
    except (OSError, EOFError, zlib.error, ValueError, KeyError, TypeError):  # spoilt, or by another version
        return None


def _place(folder: Path, record: Record) -> Path:
    return folder / "report-words" / f"{record.id}.json.gz"
