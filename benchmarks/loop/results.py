"""Results on file, one line for each table, so that a run that was interrupted continues where it stopped."""

import json
from collections.abc import Iterable, Iterator
from pathlib import Path

from benchmarks.loop.jobs import Record


def read_results(path: Path) -> dict[str, Record]:
    """Return the results on file by key. A last line that was cut off is removed from the file."""
    if not path.exists():
        return {}
    content = path.read_bytes()
    whole = content[: content.rfind(b"\n") + 1]
    if len(whole) < len(content):
        path.write_bytes(whole)
    return {record["key"]: record for record in map(json.loads, whole.decode().splitlines())}


def streamed(records: Iterable[Record], path: Path) -> Iterator[Record]:
    """Append every record to the file as soon as it is there."""
    with path.open("a", encoding="utf-8", newline="\n") as file:
        for record in records:
            file.write(json.dumps(record) + "\n")
            file.flush()
            yield record
