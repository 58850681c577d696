"""A bank of simulated observation tables, each with the truth behind it, to judge an analysis by.

It shares nothing with the analysis but the container of a table: geometry, clock, noise and the form of every effect
are its own, and every nonlinear effect takes one of several forms, drawn by the seed.
"""

from benchmarks.bank.catalogue import BELONGS_TO, LARGEST, NAMED
from benchmarks.bank.files import write_csv, write_truth
from benchmarks.bank.lists import (
    ALL_DESIGNS,
    DESIGNS,
    DEVELOPMENT,
    REPORTED,
    beyond,
    clean,
    heavy,
    missing_columns,
    mixture,
    novel,
    pairs,
    power,
    singles,
    triples,
)
from benchmarks.bank.novel import NOVEL
from benchmarks.bank.scene import Unit
from benchmarks.bank.table import Case, Spec, Stage, Truth, make_stage, make_table, read_on

__all__ = [
    "ALL_DESIGNS",
    "BELONGS_TO",
    "DESIGNS",
    "DEVELOPMENT",
    "LARGEST",
    "NAMED",
    "NOVEL",
    "REPORTED",
    "Case",
    "Spec",
    "Stage",
    "Truth",
    "Unit",
    "beyond",
    "clean",
    "heavy",
    "make_stage",
    "make_table",
    "missing_columns",
    "mixture",
    "novel",
    "pairs",
    "power",
    "read_on",
    "singles",
    "triples",
    "write_csv",
    "write_truth",
]
