"""Score the product on this bank: `python -m benchmarks.blind --kinds unnamed clean --count 60 200 --seed 1`."""

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from benchmarks.blind.lists import LISTS
from benchmarks.blind.report import by_kind, misses, unnamed_lines
from benchmarks.blind.running import outcome, tables


def main(arguments: list[str] | None = None) -> None:
    """Run what is asked for, and report."""
    parser = _parser()
    asked = parser.parse_args(arguments)
    counts = asked.count * len(asked.kinds) if len(asked.count) == 1 else asked.count
    firsts = asked.first * len(asked.kinds) if len(asked.first) == 1 else asked.first
    if all(first >= count for first, count in zip(firsts, counts, strict=True)):
        parser.error("no table lies between --first and --count, which is where it ends")
    if asked.json and asked.json.exists():
        parser.error(f"{asked.json} is there already; name another file for --json")
    records: list[dict[str, Any]] = []
    for kind, count, first in zip(asked.kinds, counts, firsts, strict=True):
        for name, spec, table, rng in tables(kind, count, asked.seed, first):
            if table is None:
                print(f"{name}: no design shows {dict(spec.effects)}", file=sys.stderr)
                continue
            records.append(outcome(name, table, rng))
            print(f"{name}: {'exact' if records[-1]['exact'] else records[-1]['said']}", file=sys.stderr, flush=True)
            if asked.json:
                asked.json.write_text(json.dumps(records, indent=1), encoding="utf-8")
    print(by_kind(records), unnamed_lines(records), misses(records), sep="\n\n")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="benchmarks.blind", description=__doc__)
    parser.add_argument("--kinds", nargs="+", choices=list(LISTS), default=list(LISTS))
    parser.add_argument("--count", nargs="+", type=int, default=[12], help="up to which number, of each kind or of all")
    parser.add_argument("--first", nargs="+", type=int, default=[0], help="number of the first table, to go on")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--json", type=Path, help="where every table's outcome is written")
    return parser


if __name__ == "__main__":
    main()
