"""Correlation coefficients as a picture."""

from collections.abc import Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_correlation
from tumble.calibrations.report.figure import Axis, Cells, Figure, Panel
from tumble.messages import Message

_READABLE = 9
"""Of more parameters the numbers would not fit into the squares."""


def correlation_picture(names: Sequence[str], coefficients: FloatArray) -> Figure:
    """The lower triangle of a matrix of correlation coefficients, shape (names, names)."""
    count = len(names)
    lower = np.where(np.tri(count, dtype=bool), coefficients, np.nan)
    texts = [
        [format_correlation(float(value)) if np.isfinite(value) else "" for value in row] if count <= _READABLE else []
        for row in lower
    ]
    places = np.arange(float(count)).tolist()
    panel = Panel(
        layers=(Cells(values=lower, texts=texts if count <= _READABLE else ()),),
        x=Axis(ticks=places, names=names, ends=(-0.5, count - 0.5)),
        y=Axis(ticks=places, names=names, ends=(count - 0.5, -0.5)),
    )
    return Figure(
        name="correlation",
        description=Message("Correlation of the parameters"),
        panels=(panel,),
        height=40.0 + 28.0 * max(count, 3),
        scale=(Message("correlation coefficient"), 1.0),
        width=720.0 if count > _READABLE else 560.0,
    )
