"""Closure: whether the earth rate that turns with the pickoff has the size that the latitude says.

Heading and drift take P and Q from one angle, so that P² + Q² is given. Fitted free, with everything found but what
changes their size, they show by how much the torquer's scale factor or the latitude errs; three positions suffice.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from scipy.special import stdtr

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, HEADING, direction
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.calibrations.tracing.trace import Trace

_OF_SIZE: Final = ("torquer_scale", "latitude")
_SEEN: Final = 1e-3
"""Of a direction, what must be left of it beside all others to be told."""


@dataclass(frozen=True, kw_only=True)
class Closure:
    """The earth rate as measured over that by the latitude, less 1."""

    value: float
    standard_uncertainty: float
    p_value: float
    """Chance of being so far from 0 where nothing changes it."""

    def as_json(self) -> dict[str, Any]:
        """As a result has it."""
        return {
            "value": self.value,
            "standard_uncertainty": self.standard_uncertainty,
            "unit": "fraction",
            "p_value": self.p_value,
        }


def closure_of(table: GyrocompassTable, trace: Trace, fit: GyrocompassFit) -> Closure | None:
    """The closure of a table beside what was found; None where its positions do not tell it."""
    heading = table.declared[:, :HEADING]
    alpha0 = float(fit.theta[ALPHA0])
    along, across = heading @ direction(alpha0), heading @ direction(alpha0 + np.pi / 2)
    found = [item.form.columns for item in trace.found if item.effect.name not in _OF_SIZE]
    others = np.column_stack([across, table.declared[:, HEADING:], *found])
    whiten, root = table.memory.whitening(trace.noise), np.sqrt(table.weights)
    columns = whiten(np.column_stack([along, others]) * root[:, None])
    output = whiten((table.output + heading @ (direction(table.scene.theta[ALPHA0])) - along) * root)
    own, left = _beside(columns[:, 1:], columns[:, 0]), _beside(columns[:, 1:], output)
    size = float(np.linalg.norm(own))
    if size < _SEEN * float(np.linalg.norm(columns[:, 0])):
        return None
    value = float(own @ left) / size**2
    freedom = max(table.rows - columns.shape[1], 1)
    uncertainty = max(fit.dwell, float(np.linalg.norm(left - value * own)) / np.sqrt(freedom)) / size
    chance = 2.0 * float(stdtr(freedom, -abs(value) / max(uncertainty, 1e-300)))
    return Closure(value=value, standard_uncertainty=uncertainty, p_value=chance)


def _beside(others: FloatArray, column: FloatArray) -> FloatArray:
    """What of a column is orthogonal to others."""
    length = np.linalg.norm(others, axis=0)
    left, values, _ = np.linalg.svd(others / np.where(length > 0.0, length, 1.0), full_matrices=False)
    span = left[:, values > 1e-8 * values[0]]
    return np.asarray(column - span @ (span.T @ column))
