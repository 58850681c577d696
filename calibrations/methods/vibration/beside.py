"""Further columns beside the coefficients and what was found, for what is shown axis by axis and band by band."""

from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.vibration.effects.curved import CURVED
from tumble.calibrations.methods.vibration.fit import VibrationFit
from tumble.calibrations.methods.vibration.table import VibrationTable
from tumble.calibrations.tracing.trace import Trace


@dataclass(frozen=True, kw_only=True)
class Beside:
    """Coefficients of some columns with their covariance, those of one column each in their order."""

    values: FloatArray
    covariance: FloatArray
    told: tuple[bool, ...]
    degrees_of_freedom: int

    @property
    def uncertainties(self) -> FloatArray:
        """Standard."""
        return np.sqrt(np.diag(self.covariance))


def corrected_ug(table: VibrationTable, fit: VibrationFit) -> FloatArray:
    """Outputs less what was found and less what is known of noise, shape (rows,)."""
    output = table.output - fit.drawn_ug
    for item, place in zip(fit.found, fit.columns, strict=True):
        size, curved = fit.coefficients[place], CURVED.get(str(item.effect.name))
        output = output - (
            item.form.columns @ size
            if curved is None
            else curved.shares(table.scene, float(size[0])).added(fit.coefficients_ug_g2)
        )
    return np.asarray(output)


def fitted_beside(
    table: VibrationTable, fit: VibrationFit, trace: Trace, columns: FloatArray, left_out: tuple[int, ...] = ()
) -> Beside:
    """Columns of shape (rows, n) fitted beside the rest outputs and the coefficients but for those left out.

    What was found is in the fit with coefficients of its own, effects that are not linear by their tangents.
    """
    table = table.with_components(trace.components)
    kept = [place for place in range(table.declared.shape[1]) if place not in left_out]
    found = [item.form.columns for item in fit.found]
    whiten, root = table.memory.whitening(trace.noise), np.sqrt(table.weights)
    whole = whiten(np.column_stack([columns, table.declared[:, kept], *found]) * root[:, None])
    output = whiten(table.output * root)
    inverse, told = pseudo_inverse(whole)
    theta = inverse @ output
    freedom = max(table.rows - int(np.linalg.matrix_rank(whole)), 1)
    variance = float(np.sum((output - whole @ theta) ** 2)) / freedom
    count = columns.shape[1]
    return Beside(
        values=theta[:count],
        covariance=variance * inverse[:count] @ inverse[:count].T,
        told=tuple(told[:count].tolist()),
        degrees_of_freedom=freedom,
    )
