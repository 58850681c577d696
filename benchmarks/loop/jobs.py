"""One table to grade, and what is kept of it."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from benchmarks.bank.lists import Wanted
from benchmarks.bank.sparse import SparseSpec
from benchmarks.bank.table import Spec

Record = dict[str, Any]
"""What is kept of one table, ready for JSON."""


@dataclass(frozen=True, kw_only=True)
class Job:
    """One table to grade by one measure."""

    measure: str
    list_name: str
    spec: Spec | SparseSpec
    seed: int

    @property
    def key(self) -> str:
        """What no other table of any measure has: the name under which a result is found again."""
        return json.dumps([self.measure, self.list_name, self.seed, asdict(self.spec)])


def jobs(measure: str, list_name: str, wanted: Wanted) -> list[Job]:
    """Turn a list of the bank into jobs."""
    return [Job(measure=measure, list_name=list_name, spec=spec, seed=seed) for spec, seed in wanted]


def spread_out(wanted: Sequence[Job], count: int | None) -> list[Job]:
    """Choose `count` jobs at even distances, or all."""
    if count is None or count >= len(wanted):
        return list(wanted)
    return [wanted[index] for index in np.linspace(0, len(wanted) - 1, count).round().astype(int)]


def described(record: Record) -> str:
    """The table of a record in a few words."""
    spec = record["spec"]
    effects = ", ".join(f"{name} {visible:g}" for name, visible in spec["effects"]) or "clean"
    left_out = f", without {' '.join(spec['left_out'])}" if spec["left_out"] else ""
    return f"{spec['design']} x{spec['realisations']}, {effects}, {spec['noise']}{left_out}, seed {record['seed']}"
