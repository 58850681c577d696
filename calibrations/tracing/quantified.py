"""What was found in a table, as numbers: the coefficients of every effect with their uncertainty."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.effect import Effect, Form, Quantity
from tumble.calibrations.tracing.table import Table, View
from tumble.calibrations.tracing.trace import Found, Trace

_STEP = 1e-3
"""Relative step for the derivative of a form with respect to what was scanned."""


@dataclass(frozen=True, kw_only=True)
class Quantified:
    """Coefficients of further columns beside a declared model, and to which effect each of them belongs."""

    found: tuple[Found, ...]
    columns: tuple[slice, ...]
    """Of each effect found, among the further columns."""
    scanned: tuple[int | None, ...]
    """Column that stands for a change of the scanned value of each effect; None where there is none."""
    coefficients: FloatArray
    covariance: FloatArray
    """Of the coefficients of all further columns."""
    residual: FloatArray
    """Output minus fitted, and minus what is known of autocorrelated noise, shape (rows,)."""
    dwell: float
    """Standard deviation of a row of weight 1, in the unit of the output."""

    def quantities(self, name: str) -> Mapping[str, Quantity]:
        """Coefficients of an effect by contract key."""
        places = [place for place, found in enumerate(self.found) if found.effect.name == name]
        effect = self.found[places[0]].effect
        largest = max(places, key=lambda place: float(np.abs(self.coefficients[self.columns[place]]).max()))
        form = self.found[largest].form
        chosen = [self.columns[place] for place in places] if effect.additive else [self.columns[largest]]
        weights = np.zeros((chosen[0].stop - chosen[0].start, len(self.coefficients)))
        for columns in chosen:
            weights[:, columns] += np.eye(len(weights))
        reported = effect.report(form, weights @ self.coefficients, weights @ self.covariance @ weights.T)
        return self._with_scanned_uncertainty(reported, form, self.scanned[largest])

    def _with_scanned_uncertainty(
        self, reported: Mapping[str, Quantity], form: Form, column: int | None
    ) -> Mapping[str, Quantity]:
        if column is None:
            return reported
        uncertainty = float(np.sqrt(self.covariance[column, column]))
        return {
            key: Quantity(value=quantity.value, standard_uncertainty=uncertainty, unit=quantity.unit)
            if key in form.scanned
            else quantity
            for key, quantity in reported.items()
        }


def level_quantities(table: Table, trace: Trace, best: Quantified, effect: Effect[Any]) -> Mapping[str, Quantity]:
    """Levels of an effect as they happened: their best linear unbiased prediction (Henderson's equations).

    The residual of the fit, free of what is known of them, is all that it takes.
    """
    (form,) = effect.forms(table.scene)
    root = np.sqrt(table.weights)
    columns, scaled = form.columns * root[:, None], table.memory.levels[effect.name]
    unit = np.linalg.norm(scaled[:, 0]) / np.linalg.norm(columns[:, 0])
    variance = dict(trace.noise.levels)[effect.name] * unit**2
    seen = table.memory.whitening(trace.noise)(columns)
    predicted = variance * columns.T @ (best.residual * root)
    left = variance * np.eye(columns.shape[1]) - variance**2 * seen.T @ seen
    return effect.report(form, predicted, best.dwell**2 * left)


def form_in(scene: View, item: Found) -> Form:
    """The form of an effect found, for the rows of another scene of the same table.

    A grid of what is scanned may hang on the rows: then the nearest value counts. Where a shape needs other rows, there
    is nothing.
    """
    if item.effect.at is not None:
        (value,) = item.form.scanned.values()
        return item.effect.at(scene, value)
    if item.effect.again is not None:
        return item.effect.again(scene, item.form.scanned)
    width = item.form.columns.shape[1]
    alike = [form for form in item.effect.forms(scene) if form.scanned.keys() == item.form.scanned.keys()]
    alike = [form for form in alike if form.columns.shape[1] == width]
    nothing = Form(columns=np.zeros((scene.rows, width)), scanned=item.form.scanned)
    return min(alike, key=lambda form: _apart(form, item.form), default=nothing)


def _apart(form: Form, other: Form) -> float:
    """How far what is scanned for lies apart."""
    return sum(abs(value - other.scanned[key]) for key, value in form.scanned.items())


def slices(widths: Sequence[int]) -> list[slice]:
    """Where columns of these widths stand, one after the other."""
    ends = np.cumsum(widths, dtype=int).tolist()
    return [slice(end - width, end) for end, width in zip(ends, widths, strict=True)]


def expectations(found: Sequence[Found], places: Sequence[slice], dwell: float) -> list[tuple[int, float, float]]:
    """What is known of coefficients beforehand: place among those of all effects, value, and its weight.

    The weight is the standard deviation of a row, `dwell`, over that of the coefficient about the value.
    """
    return [
        (columns.start, known.value, dwell / known.standard_deviation)
        for item, columns in zip(found, places, strict=True)
        if (known := item.effect.expected) is not None
    ]


def tangent(scene: View, item: Found, coefficients: FloatArray) -> FloatArray | None:
    """Change of the effect with its scanned value, shape (rows, 1); None where that is no smooth change."""
    if item.effect.at is None:
        return None
    (value,) = item.form.scanned.values()
    step = _STEP * value
    above, below = (item.effect.at(scene, value + side * step).columns for side in (1.0, -1.0))
    change = (above - below) @ coefficients / (2 * step)
    smooth = np.count_nonzero(change) > len(change) // 10
    return np.asarray(change[:, None]) if smooth else None
