"""Reads observation tables of an accelerometer."""

from pathlib import Path

from tumble.calibrations.core.table import read_rows
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.screening import set_aside_bad_rows


def read_table(path: Path) -> Observations:
    """Read an observation table.

    Rows with NaN, infinity, an overload or a missing value are set aside and listed; a missing temperature, scatter or
    direction is only warned of. Columns that the format does not know are kept in `Observations.extra`; one that is
    known and empty is left out.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file: one sentence with file, line, column and remedy.
    """
    return set_aside_bad_rows(read_rows(path, Observations))
