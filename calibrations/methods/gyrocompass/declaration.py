"""What a table declares of the noise of its gyro: refused where it is no noise, and said where it cannot be used."""

from dataclasses import replace
from pathlib import Path
from typing import Final, TypeVar

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.table import line_of
from tumble.messages import Message

SIZES: Final = (
    "angle_random_walk_deg_sqrt_h",
    "bias_instability_deg_h",
    "rate_random_walk_deg_h_sqrt_h",
    "gauss_markov_deg_h",
)
"""Columns of N, B, K and of the standard deviation of a Gauss-Markov process."""
CORRELATION: Final = "correlation_s"
"""Column of its correlation time."""
_LEAST, _MOST = 1e-9, 1e6
"""Between these lies what is told of any gyro."""
_R = TypeVar("_R", bound=Rows)


def with_checked_noise(rows: _R, path: Path) -> _R:
    """The table, with a warning where it declares a noise and not when its dwells were.

    Raises
    ------
    TableError
        A size that no noise has, or another one than in a row above.
    """
    for name in (*SIZES, CORRELATION):
        _check(rows, name, path)
    declares = any(np.any(values > 0.0) for name in SIZES if (values := rows.values(name)) is not None)
    if not declares or dwell_times(rows) is not None:
        return rows
    sentence = Message(
        "{source}: it declares a noise, but its dwells overlap, or time_s or dwell_s is missing or not above 0; the "
        "declared noise is not used",
        source=rows.source,
    )
    return replace(rows, warnings=(*rows.warnings, sentence))


def dwell_times(rows: Rows) -> tuple[FloatArray, FloatArray] | None:
    """Begin and end of every dwell, in seconds; None where the table does not say, or where dwells overlap."""
    dwell_s = rows.values("dwell_s")
    if rows.time_s is None or dwell_s is None or not np.isfinite(dwell_s).all():
        return None
    starts_s, ends_s = rows.time_s - dwell_s / 2.0, rows.time_s + dwell_s / 2.0
    order = np.argsort(starts_s)
    apart = np.all(starts_s[order][1:] > ends_s[order][:-1] - 1e-6 * dwell_s[order][1:])
    return (starts_s, ends_s) if apart and np.all(dwell_s > 0.0) else None


def _check(rows: Rows, name: str, path: Path) -> None:
    """Refuse a column with what is no size of a noise, or with two sizes. Raises `TableError`."""
    values = rows.values(name)
    if values is None or not (told := ~np.isnan(values)).any():
        return
    of_none = (values == 0.0) & (name != CORRELATION)
    bad = told & ~of_none & ~((values >= _LEAST) & (values <= _MOST))
    if bad.any():
        first = int(np.argmax(bad))
        raise TableError(
            Message(
                "{path}, line {line}, column {name}: {value:g} is nothing that a gyro has; write a number from "
                "{least:g} to {most:g}, or leave the column out",
                path=path,
                line=line_of(path, int(rows.row[first])),
                name=name,
                value=values[first],
                least=_LEAST,
                most=_MOST,
            )
        )
    declared = values[told][0]
    if np.any(other := told & (values != declared)):
        first = int(np.argmax(other))
        raise TableError(
            Message(
                "{path}, line {line}, column {name}: {value:g}, and {declared:g} in a line above; declare one gyro, "
                "the same in every row",
                path=path,
                line=line_of(path, int(rows.row[first])),
                name=name,
                value=values[first],
                declared=declared,
            )
        )
