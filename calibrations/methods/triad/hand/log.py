"""A log of three outputs, with or without time: one row a sample, or one row a pose."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.files import read_header
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.core.table import read_rows
from tumble.messages import Message

_OUTPUT: Final = re.compile(r"u_([xyz])_(\w+)")


@dataclass(frozen=True, kw_only=True)
class LogRows(Rows):
    """Rows of a log; the three outputs stand in `extra`, named by their unit."""

    settings: ClassVar = ()


@dataclass(frozen=True, kw_only=True)
class Log:
    """Outputs of a triad in the order in which they were taken."""

    rows: LogRows
    outputs: FloatArray
    """Shape (rows, 3), in `unit`."""
    unit: str

    @property
    def time_s(self) -> FloatArray | None:
        """Time of each row; None where every row is a pose."""
        return self.rows.time_s


def output_names(header: tuple[str, ...] | list[str]) -> tuple[str, str, str] | None:
    """The three columns of outputs, `u_x_…`, `u_y_…`, `u_z_…` in one unit; None where there are none."""
    found = {match[1]: match[2] for name in header if (match := _OUTPUT.fullmatch(name))}
    if found.keys() != {"x", "y", "z"} or len({*found.values()}) != 1:
        return None
    unit = found["x"]
    return f"u_x_{unit}", f"u_y_{unit}", f"u_z_{unit}"


def read_log(path: Path) -> Log:
    """Read a log. Raises `TableError`: unreadable or malformed, or an output that is no number."""
    names = output_names(read_header(path))
    assert names is not None, "the method has looked"
    rows = without_missing(read_rows(path, LogRows))
    values = []
    for name in names:
        found = rows.extra.get(name)
        if found is None or not np.issubdtype(found.dtype, np.floating):
            raise TableError(
                Message("{path}, column {name}: holds something that is not a number", path=path, name=name)
            )
        values.append(found)
    return Log(rows=rows, outputs=np.column_stack(values).astype(float), unit=names[0].removeprefix("u_x_"))
