"""The course of structure without a name: what is known of it at the places of the table, so that it can be predicted.

Given its variance, it is a best linear unbiased prediction (Henderson 1975; Rasmussen and Williams, 2.7): the mean of
the component given the rows, with what is not known of it, and of the model beside it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.coordinate import IntArray
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.table import Table


@dataclass(frozen=True, kw_only=True, eq=False)
class Course:
    """What a channel does along a variable, at places of the variable."""

    channel: str
    """Of the component: offset, scale, angle."""
    channel_detail: str
    """Which of several channels of the same word it is; empty where there is one."""
    unit: str
    """Of the channel: what is added to the output, to the response to ax, or to the angle of the head."""
    variable: str
    detail: str
    """Which of several variables of the same word it is; empty where there is one."""
    variable_unit: str
    at: FloatArray
    """Places in the order of the variable, shape (places,), or (places, 3) of a pose."""
    value: FloatArray
    standard_uncertainty: FloatArray

    def as_json(self) -> dict[str, Any]:
        """Under keys of `unexplained`."""
        return {
            "channel": self.channel,
            "channel_detail": self.channel_detail,
            "unit": self.unit,
            "variable": self.variable,
            "detail": self.detail,
            "variable_unit": self.variable_unit,
            "at": self.at.tolist(),
            "value": self.value.tolist(),
            "standard_uncertainty": self.standard_uncertainty.tolist(),
        }


@dataclass(frozen=True, kw_only=True, eq=False)
class Rows:
    """A fit with components, row by row."""

    table: Table
    """With the components."""
    noise: NoiseModel
    columns: FloatArray
    """What else was fitted, linearised, shape (rows, n)."""
    residual: FloatArray
    """Output minus fitted, free of what is known of the components, shape (rows,)."""
    dwell: float
    """Standard deviation of a row of weight 1."""


def courses(rows: Rows, components: Sequence[Component]) -> tuple[Course, ...]:
    """The course of each component; where it acts on no row of a place, nothing is known of that place."""
    variances = dict(rows.noise.levels)
    return tuple(_course(rows, component, variances) for component in components)


def _course(rows: Rows, component: Component, variances: Mapping[str, float]) -> Course:
    axis, gain = component.axis, component.axis.channel.gain
    root, level, variance = np.sqrt(rows.table.weights), _level(rows, component), variances[component.name]
    places = _places(component)
    directions = level[places] / (root * gain)[places, None]
    value = directions @ (variance * level.T @ (rows.residual * root))
    unseen = np.eye(level.shape[1]) - variance * _seen(rows, level)
    spread = np.einsum("ij,jk,ik->i", directions, variance * unseen, directions)
    return Course(
        channel=axis.channel.word,
        channel_detail=axis.channel.detail,
        unit=axis.channel.unit,
        variable=axis.coordinate.word,
        detail=axis.coordinate.detail,
        variable_unit=axis.coordinate.unit,
        at=axis.coordinate.values[places],
        value=np.asarray(value),
        standard_uncertainty=rows.dwell * np.sqrt(np.clip(spread, 0.0, None)),
    )


def _level(rows: Rows, component: Component) -> FloatArray:
    return rows.table.memory.levels[component.name]


def _seen(rows: Rows, level: FloatArray) -> FloatArray:
    """What the rows say of the coefficients of a component beside everything else, shape (n, n)."""
    whiten = rows.table.memory.whitening(rows.noise)
    beside = whiten(rows.columns * np.sqrt(rows.table.weights)[:, None])
    length = np.linalg.norm(beside, axis=0)
    span, values, _ = np.linalg.svd(beside / np.where(length > 0.0, length, 1.0), full_matrices=False)
    span, shown = span[:, values > _RANK], whiten(level)
    shown = shown - span @ (span.T @ shown)
    return np.asarray(shown.T @ shown)


_RANK = 1e-10
"""Directions in which columns differ by less than this part of their length are one."""


def _places(component: Component) -> IntArray:
    """Numbers of the rows in which the component is seen best, one for each place, in the order of the places."""
    coordinate, gain = component.axis.coordinate, np.abs(component.axis.channel.gain)
    order = np.lexsort((-gain, coordinate.bins))
    first = np.unique(coordinate.bins[order], return_index=True)[1]
    rows = order[first][gain[order[first]] > 0.0]
    return np.asarray(rows if coordinate.values.ndim > 1 else rows[np.argsort(coordinate.values[rows], kind="stable")])
