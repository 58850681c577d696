"""A second bank, made from the contract and the digest of the physics alone, by someone who had not read the tracer.

It reads only what the contract says (`domain.md`, `observations.md`, `effects.md`, `result.md`), and asks the product
only through its command, `tumble close-loop`. Results are judged from its JSON.
"""

from benchmarks.blind.lists import LISTS
from benchmarks.blind.running import outcome, tables
from benchmarks.blind.table import Spec, Table, make_table
from benchmarks.blind.unnamed import KINDS

__all__ = ["KINDS", "LISTS", "Spec", "Table", "make_table", "outcome", "tables"]
