"""What changes between two visits to one setting, free of whatever the settings differ by."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.blocks import within
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.effect import Effect, Structure
from tumble.calibrations.tracing.findings import EffectFound, Unexplained
from tumble.calibrations.tracing.linear_loop import LinearExplained, explain_linear
from tumble.calibrations.tracing.noise import Memory
from tumble.calibrations.tracing.table import Table, View
from tumble.messages import Message

_SPREAD = 0.25
"""Where so much of the scatter of the times lies within settings, they are what shows a drift."""
_SPARE_ROWS = 6
"""So many rows more than settings are needed."""


@dataclass(frozen=True, kw_only=True)
class WithinTable(Table):
    """Rows beside the mean of their setting."""

    @property
    def fewest_rows(self) -> int:
        """A mean for each setting, and some rows to spare."""
        return self.model.parameters + _SPARE_ROWS


@dataclass(frozen=True, kw_only=True)
class Within:
    """What was found within the settings."""

    explained: LinearExplained[WithinTable]

    @cached_property
    def shift(self) -> FloatArray:
        """What it adds to the output of every row, shape (rows,)."""
        best = self.explained.best
        parts = [item.form.columns @ best.coefficients[columns]
                 for item, columns in zip(best.found, best.columns, strict=True)]  # fmt: skip
        return np.asarray(sum(parts, np.zeros(self.explained.table.rows)))

    @property
    def effects(self) -> tuple[EffectFound, ...]:
        """Those with a name."""
        return self.explained.effects(self.explained.best)

    @property
    def unexplained(self) -> tuple[Unexplained, ...]:
        """What has none."""
        return self.explained.unexplained


def too_few(rows: int, fewest: int, counted: str, visits: int = 0) -> str:
    """Why nothing is looked for in so many rows, `counted` in words, that were visited so often; else empty."""
    if rows >= fewest:
        return ""
    if not visits:
        return Message.counted(
            "{counted} is too few; at least {fewest} are needed",
            "{counted} are too few; at least {fewest} are needed",
            count=rows,
            counted=counted,
            fewest=fewest,
        )
    return Message.counted(
        "{counted} ({visited}) is too few; at least {fewest} are needed",
        "{counted} ({visited}) are too few; at least {fewest} are needed",
        count=rows,
        counted=counted,
        visited=Message.counted("visited {count} time", "visited {count} times", count=visits),
        fewest=fewest,
    )


def lies_within(times: FloatArray, setting: NDArray[np.int64]) -> bool:
    """Whether settings were visited again after some time, so that a drift shows between their visits."""
    return bool(np.ptp(times) > 0 and within(times, setting) >= _SPREAD)


def trace_within(
    scene: View,
    setting: NDArray[np.int64],
    output: FloatArray,
    unit: str,
    effects: Sequence[Effect[Any]],
    structures: Sequence[Structure[Any]] = (),
) -> Within:
    """Trace what the rows of a setting differ by; `setting` numbers them from 0."""
    count = int(setting.max()) + 1
    table = WithinTable(
        model=Linear(functions=(setting[:, None] == np.arange(count)).astype(np.float64)),
        output=output,
        unit=unit,
        weights=np.ones(len(output)),
        scene=scene,
        effects=tuple(effects),
        structures=tuple(structures),
        memory=Memory(modes=np.empty((len(output), 0))),
    )
    return Within(explained=explain_linear(table, {f"setting {number}": unit for number in range(count)}))
