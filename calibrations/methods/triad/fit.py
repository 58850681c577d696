"""The vector fit: fourteen parameters by generalised least squares, beside what was found."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed, compress
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.triad.geometry import ARCSEC_PER_RAD
from tumble.calibrations.methods.triad.model import INTERNAL, NAMES, UNITS, response, stated, stated_slopes
from tumble.calibrations.methods.triad.table import TriadTable
from tumble.calibrations.tracing.effect import Form
from tumble.calibrations.tracing.quantified import Quantified, slices, tangent
from tumble.calibrations.tracing.trace import Trace
from tumble.messages import Message

_SEEN = 1e-6
"""A parameter that shares more than this with directions that no row sees is not identifiable."""


@dataclass(frozen=True, kw_only=True)
class TriadFit(Quantified):
    """Parameters beside the coefficients of what was found."""

    theta: FloatArray
    """Internal parameters, as in `model`."""
    internal_covariance: FloatArray
    """Of the internal parameters, shape (14, 14)."""
    parameter_covariance: FloatArray
    """Of the stated parameters, shape (14, 14)."""
    identified: NDArray[np.bool_]
    """Which of the stated parameters the positions tell, shape (14,)."""
    degrees_of_freedom: int
    compressed: Compressed
    """The rows as the functions and what was found see them, white."""
    drawn_v: FloatArray
    """What is known of what is noise to a fit, structure without a name above all, shape (rows,), in volts."""
    everything: FloatArray
    """Internal parameters and the coefficients of all further columns."""
    inverse: FloatArray
    """From a change of the compressed rows to the step of all of them, shape (parameters, compressed rows)."""

    @property
    def values(self) -> FloatArray:
        """The stated parameters, shape (14,)."""
        return stated(self.theta)

    @property
    def deviations_v(self) -> FloatArray:
        """Residual of each dwell and channel, shape (dwells, 3), in volts."""
        return self.residual.reshape(-1, 3)

    @property
    def correction(self) -> FloatArray:
        """K⁻¹, g per volt: `a = correction @ (u - bias)`, shape (3, 3)."""
        return np.asarray(np.linalg.inv(response(self.theta)), dtype=float)

    def mismatch_arcsec(self, outputs_v: FloatArray) -> FloatArray:
        """|a| - 1 for outputs of shape (dwells, 3), in arc seconds of the local gravity, shape (dwells,)."""
        corrected = (outputs_v - self.theta[:3]) @ self.correction.T
        return np.asarray((np.linalg.norm(corrected, axis=1) - 1.0) * ARCSEC_PER_RAD)

    def parameters(self) -> dict[str, Parameter]:
        """The fourteen parameters with their uncertainty, or why there is none."""
        factor = coverage_factor(self.degrees_of_freedom)
        uncertainty = np.sqrt(np.diag(self.parameter_covariance))
        found = {}
        for name, value, u, seen in zip(NAMES, self.values, uncertainty, self.identified, strict=True):
            whole = Parameter(
                name=name,
                unit=UNITS[name],
                value=float(value),
                standard_uncertainty=float(u),
                type_a=float(u),
                degrees_of_freedom=float(self.degrees_of_freedom),
                interval_95=(float(value - factor * u), float(value + factor * u)),
            )
            found[name] = whole if seen else whole.withheld(Message("these positions do not tell it"))
        return found


def fit_triad(table: TriadTable, trace: Trace) -> TriadFit:
    """Fit the declared model with what was found.

    What was scanned for counts as fitted: the change of each form with its scanned value is a column of its own.
    """
    found, table = trace.found, table.with_components(trace.components)
    places = slices([item.form.columns.shape[1] for item in found])
    first = table.fit(trace.forms, trace.noise).theta[INTERNAL:]
    changes = [tangent(table.scene, item, first[place]) for item, place in zip(found, places, strict=True)]
    columns = [*(item.form.columns for item in found), *(change for change in changes if change is not None)]
    return _solved(table, trace, columns, places, changes)


def _solved(
    table: TriadTable,
    trace: Trace,
    columns: Sequence[FloatArray],
    places: Sequence[slice],
    changes: Sequence[FloatArray | None],
) -> TriadFit:
    noise, root = trace.noise, np.sqrt(table.weights)
    theta = table.fit([Form(columns=each) for each in columns], noise).theta
    whole = np.column_stack([table.declared, *columns])
    misfit = table.output - whole @ table.model.coefficients(theta)
    whiten = table.memory.whitening(noise)
    residual_v = np.asarray(whiten(whiten(misfit * root)) / root)
    compressed = compress(whole, table.output, table.weights, whiten)
    jacobian = np.column_stack([table.declared @ table.model.slopes(theta), *columns])
    inverse, _ = pseudo_inverse(whiten(jacobian * root[:, None]))
    freedom = max(table.rows - jacobian.shape[1], 1)
    variance = float(np.sum(whiten(misfit * root) ** 2)) / freedom
    together = variance * inverse @ inverse.T
    slopes = stated_slopes(theta)
    numbers = iter(range(places[-1].stop if places else 0, len(theta) - INTERNAL))
    return TriadFit(
        found=trace.found,
        columns=tuple(places),
        scanned=tuple(None if change is None else next(numbers) for change in changes),
        coefficients=theta[INTERNAL:],
        covariance=together[INTERNAL:, INTERNAL:],
        residual=residual_v,
        dwell=float(np.sqrt(variance)),
        theta=theta[:INTERNAL],
        internal_covariance=together[:INTERNAL, :INTERNAL],
        parameter_covariance=slopes @ together[:INTERNAL, :INTERNAL] @ slopes.T,
        identified=_identified(whiten(jacobian * root[:, None]), slopes),
        degrees_of_freedom=freedom,
        compressed=compressed,
        drawn_v=misfit - residual_v,
        everything=theta,
        inverse=pseudo_inverse(_stepped(compressed.r, table.model.slopes(theta)))[0],
    )


def _stepped(r: FloatArray, slopes: FloatArray) -> FloatArray:
    """What a step of all parameters does to compressed rows, the declared ones by the slopes of the functions."""
    functions = len(slopes)
    return np.column_stack([r[:, :functions] @ slopes, r[:, functions:]])


def _identified(jacobian: FloatArray, slopes: FloatArray) -> NDArray[np.bool_]:
    """Which stated parameters have no part in directions that no row sees."""
    norm = np.linalg.norm(jacobian, axis=0)
    scale = np.where(norm > 0, norm, 1.0)
    _, values, vectors = np.linalg.svd(jacobian / scale, full_matrices=True)
    rank = int(np.sum(values > 1e-8 * values[0]))
    unseen = (vectors[rank:] / scale)[:, : slopes.shape[1]]
    whole = np.sqrt(np.sum((slopes / scale[: slopes.shape[1]]) ** 2, axis=1))
    return np.asarray(np.linalg.norm(slopes @ unseen.T, axis=1) < _SEEN * whole)
