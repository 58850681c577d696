"""Makes tables, has the product trace them, and judges what it says."""

import json
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from click.testing import CliRunner

from benchmarks.blind.files import write_table
from benchmarks.blind.lists import LISTS
from benchmarks.blind.score import score
from benchmarks.blind.sizing import CannotShowError
from benchmarks.blind.table import Spec, Table, make_table
from tumble.app.cli import cli


def tables(
    kind: str, count: int, seed: int, first: int = 0
) -> Iterator[tuple[str, Spec, Table | None, np.random.Generator]]:
    """Make the tables of a kind: name, what was asked, the table or None where no design shows it, its generator.

    A table is fixed by the seed, its kind and its number; `first` leaves out those before.
    """
    place = list(LISTS).index(kind)
    specs = LISTS[kind](count, np.random.default_rng([seed, place]))
    for number, spec in enumerate(specs[first:], start=first):
        rng = np.random.default_rng([seed, place, number])
        try:
            made = make_table(spec, rng)
        except CannotShowError:
            made = None
        yield f"{kind}-{number:03d}", spec, made, rng


def traced(path: Path) -> dict[str, Any]:
    """Return what `tumble close-loop FILE --json OUT` says of a table (result.md).

    Raises
    ------
    RuntimeError
        Where the command ends with another status than the documented 0 and 1.
    """
    said = path.with_suffix(".json")
    answer = CliRunner().invoke(cli, ["close-loop", str(path), "--json", str(said)], catch_exceptions=False)
    if answer.exit_code not in (0, 1):
        raise RuntimeError(f"{path.name}: close-loop ended with status {answer.exit_code}: {answer.output[-500:]}")
    return dict(json.loads(said.read_text(encoding="utf-8")))


def outcome(name: str, table: Table, rng: np.random.Generator) -> dict[str, Any]:
    """Trace one table and judge the answer."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.csv"
        write_table(path, table, rng)
        start = time.perf_counter()
        result = traced(path)
        seconds = time.perf_counter() - start
    return {"id": name, **table.truth(), **score(table, result), "seconds": seconds}
