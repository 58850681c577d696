"""The queue of a store as a file, so that it outlives the window."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

from tumble.app.files import write_text
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.system_errors import reason
from tumble.window.work.run_queue import Entry

NAME: Final = "queue.json"
_SCHEMA: Final = "tumble.queue/1"


def read_queue(folder: Path) -> tuple[tuple[Entry, ...], InputError | None]:
    """The entries that a store keeps, and what was wrong with their file, which then is kept under another name."""
    path = folder / NAME
    try:
        return _entries(json.loads(path.read_text(encoding="utf-8"))), None
    except FileNotFoundError:
        return (), None
    except OSError as error:
        return (), InputError(Message("{path}: cannot be read ({reason})", path=path, reason=reason(error)))
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return (), _set_aside(path)


def write_queue(folder: Path, entries: Iterable[Entry]) -> None:
    """Keep the entries in place of those before, all or none. Raises `InputError`, `JobError`."""
    document = {"schema": _SCHEMA, "entries": [entry.as_json() for entry in entries]}
    write_text(folder / NAME, json.dumps(document, indent=1, ensure_ascii=False) + "\n")


def _entries(document: dict[str, Any]) -> tuple[Entry, ...]:
    if document["schema"] != _SCHEMA:
        raise ValueError(document["schema"])
    entries = tuple(map(Entry.from_json, document["entries"]))
    if len({entry.number for entry in entries}) < len(entries):
        raise ValueError("two entries have one number")
    return entries


def _set_aside(path: Path) -> InputError:
    numbered = (path.with_name(f"{path.stem}.damaged-{number}{path.suffix}") for number in range(1, 1_000_000))
    aside = next(place for place in numbered if not place.exists())
    try:
        path.rename(aside)
    except OSError as error:
        return InputError(
            Message("{path}: is damaged, and cannot be renamed ({reason})", path=path, reason=reason(error))
        )
    return InputError(
        Message("{path}: is no queue that can be read; it is kept as {aside}", path=path, aside=aside.name)
    )
