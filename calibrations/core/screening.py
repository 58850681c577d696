"""Setting aside what no instrument can have measured: missing values, an overload, a garbled number."""

from dataclasses import replace
from typing import Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.rows import OVERLOAD, Rows, SetAside
from tumble.messages import Message

MOSTLY: Final = 0.5
"""Where more rows than this part hold what cannot be, the column is in another unit and is asked about."""
SENSORS_DEGC: Final = (-100.0, 250.0)
"""Beyond these no sensor at a stand reads a temperature."""
_LONE_K: Final = 2.0
_LONE_TIMES: Final = 20.0
"""A temperature that leaves both its neighbours by so much, and so many times their usual difference, is garbled."""
_FEWEST_STEPS: Final = 8
"""Fewer differences do not tell what is usual."""
_R = TypeVar("_R", bound=Rows)


def without_missing(rows: _R, overloads: tuple[str, ...] = ()) -> _R:
    """Return the table without rows in which a needed value is not finite, each listed once with its reason.

    In the columns `overloads`, by their fields, a value beyond `OVERLOAD` is none either.
    """
    reasons: dict[int, str] = {}
    for name, declared in rows.columns().items():
        column: FloatArray | None = getattr(rows, name)
        if not declared.needed or column is None:
            continue
        bad = ~np.isfinite(column)
        if name in overloads:
            bad |= np.abs(column) > OVERLOAD
        for row, value in zip(rows.row[bad].tolist(), column[bad].tolist(), strict=True):
            reasons.setdefault(row, _no_value(name, value))
    return rows.without(tuple(SetAside(row=row, reason=reason) for row, reason in reasons.items()))


def beyond(rows: Rows, name: str, bad: NDArray[np.bool_], what: str, *, gross: bool = False) -> tuple[SetAside, ...]:
    """Rows whose value of a column is beyond anything that can be measured; `what` says beyond what."""
    values: FloatArray = getattr(rows, name)

    spelt = rows.columns()[name].name
    return tuple(
        SetAside(row=row, reason=_too_far(spelt, value, what, gross), gross=gross)
        for row, value in zip(rows.row[bad].tolist(), values[bad].tolist(), strict=True)
    )


def _no_value(name: str, value: float) -> Message:
    if np.isfinite(value):
        return Message("overload: {name} is {value:g}", name=name, value=value)
    return Message("{name} is {value}", name=name, value=value)


def _too_far(name: str, value: float, what: str, gross: bool) -> Message:
    if gross:
        return Message("gross error: {name} is {value:g}, beyond {what}", name=name, value=value, what=what)
    return Message("{name} is {value:g}, beyond {what}", name=name, value=value, what=what)


def with_likely_temperatures(rows: _R, name: str = "temperature_degc") -> _R:
    """The table without single temperatures that no sensor reads; where most are so, the unit is asked about."""
    temperature_degc: FloatArray | None = getattr(rows, name)
    if temperature_degc is None:
        return rows
    unlikely = (temperature_degc < SENSORS_DEGC[0]) | (temperature_degc > SENSORS_DEGC[1])
    if np.count_nonzero(unlikely) > MOSTLY * len(temperature_degc):
        return rows
    return used_without(rows, name, unlikely | _alone(temperature_degc))


def used_without(rows: _R, name: str, bad: NDArray[np.bool_]) -> _R:
    """The table with the values of a column left out where they are `bad`, and a sentence that says so."""
    if not bad.any():
        return rows
    values: FloatArray = getattr(rows, name)
    others = int(np.count_nonzero(bad)) - 1
    first = int(np.argmax(bad))
    where = Message("row {row}", row=rows.row[first])
    if others:
        where = Message.counted(
            "row {row} and likewise in {count} other",
            "row {row} and likewise in {count} others",
            row=rows.row[first],
            count=others,
        )
    sentence = Message(
        "{source}: {column} is {value:g} in {where}; used without it",
        source=rows.source,
        column=rows.columns()[name].name,
        value=values[first],
        where=where,
    )
    without: dict[str, Any] = {name: np.where(bad, np.nan, values)}
    return replace(rows, **without, warnings=(*rows.warnings, sentence))


def _alone(values: FloatArray) -> NDArray[np.bool_]:
    """Which single values, in the order of the rows, lie far to one side of both neighbours; at an end, of two."""
    steps = np.diff(values)
    if len(steps) < _FEWEST_STEPS or not np.isfinite(steps).any():
        return np.zeros(len(values), dtype=bool)
    limit = max(_LONE_K, _LONE_TIMES * float(np.nanmedian(np.abs(steps))))
    before = np.concatenate([[values[0] - values[2]], steps])
    after = np.concatenate([-steps, [values[-1] - values[-3]]])
    far = np.minimum(np.abs(before), np.abs(after)) > limit
    return np.asarray(far & (np.sign(before) == np.sign(after)))
