"""Runs as somebody names them: by a file, by a record, or by a result; and the units that they are of."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from tumble.app.adopted_effects import with_what_is_known
from tumble.app.analysed import Analysed
from tumble.app.analysing import fit
from tumble.app.joining import read_together
from tumble.app.measurement import Measurement
from tumble.app.measurements import read_measurement
from tumble.app.recall import recall
from tumble.calibrations.core.bounded import read_bounded
from tumble.messages import Message
from tumble.procedures.errors import InputError

_RESULT_SUFFIX: Final = ".json"


def measured(source: str, stand: Mapping[str, Any] | None, folder: Path) -> Measurement:
    """A run: of a file, of a record of the store, or of the record that a result says it was kept as."""
    path = Path(source)
    if path.suffix.lower() == _RESULT_SUFFIX:
        return recall(folder, _record_in(path))[1]
    if path.exists() or path.suffix:
        return read_measurement(path, stand)
    return recall(folder, source)[1]


def _record_in(path: Path) -> str:
    """The record of which a result (JSON) says that it was kept. Raises `InputError`."""
    try:
        content = json.loads(read_bounded(path))
    except (ValueError, RecursionError) as error:
        raise InputError(Message("{path}: is no result (JSON); give a recording or a table", path=path)) from error
    record = content.get("record") if isinstance(content, dict) else None
    if not isinstance(record, str):
        raise InputError(
            Message("{path}: does not say from which record it comes; give the recording or the table", path=path)
        )
    return record


def units_of(measurements: Sequence[Measurement], folder: Path) -> list[Analysed]:
    """One analysed run for each unit. Raises `InputError`."""
    by_unit: dict[str, list[Measurement]] = {}
    for each in measurements:
        unit = each.header.serial_number if each.header else str(each.path)
        by_unit.setdefault(unit, []).append(each)
    together = [
        files[0] if len(files) == 1 else read_together([each.path for each in files], files[0].stand)
        for files in by_unit.values()
    ]
    return [fit(with_what_is_known(each, folder), trials=0, folder=folder) for each in together]
