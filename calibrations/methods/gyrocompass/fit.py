"""Heading and drift by generalised least squares, beside what was found."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed, compress
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.gyrocompass.geometry import wrapped_deg
from tumble.calibrations.methods.gyrocompass.model import NAMES, UNITS
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.calibrations.methods.gyrocompass.weights import variance_by_samples
from tumble.calibrations.tracing.effect import Form
from tumble.calibrations.tracing.quantified import Quantified, slices, tangent
from tumble.calibrations.tracing.trace import Trace
from tumble.messages import Message

STATED: Final = len(NAMES)
"""Parameters that are stated; the others are the leans."""
_FEW: Final = 8
"""Degrees of freedom below which the samples within dwells are asked for the noise."""
_SEEN: Final = 1e-6
"""A parameter that shares more than this with directions that no row sees is not identifiable."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassFit(Quantified):
    """Heading and drift beside the coefficients of what was found."""

    theta: FloatArray
    """α0 in radians, drift in °/h, and the leans."""
    parameter_covariance: FloatArray
    """Of α0 in degrees and the drift, shape (2, 2)."""
    identified: NDArray[np.bool_]
    """Which of both the positions tell."""
    degrees_of_freedom: int
    compressed: Compressed
    """The rows as the functions and what was found see them, white."""
    inverse: FloatArray
    """From a change of the compressed rows to the step of all parameters and coefficients."""
    drawn: FloatArray
    """What is known of what is noise to a fit, shape (rows,)."""
    everything: FloatArray
    """Parameters and the coefficients of all further columns."""

    @property
    def values(self) -> Mapping[str, float]:
        """α0 in degrees, above -180 up to 180, and the drift in °/h."""
        return {"alpha0": wrapped_deg(float(np.rad2deg(self.theta[0]))), "drift": float(self.theta[1])}

    def parameters(self) -> dict[str, Parameter]:
        """Both with their uncertainty, or why there is none."""
        uncertainties = np.sqrt(np.diag(self.parameter_covariance)).tolist()
        found = {}
        for name, u, seen in zip(NAMES, uncertainties, self.identified, strict=True):
            whole = _stated(name, self.values[name], u, self.degrees_of_freedom)
            found[name] = whole if seen else whole.withheld(Message("these positions do not tell it"))
        return found


def _stated(name: str, value: float, uncertainty: float, freedom: int) -> Parameter:
    half = coverage_factor(freedom) * uncertainty
    return Parameter(
        name=name,
        unit=UNITS[name],
        value=value,
        standard_uncertainty=uncertainty,
        type_a=uncertainty,
        degrees_of_freedom=float(freedom),
        interval_95=(value - half, value + half),
    )


def fit_gyrocompass(table: GyrocompassTable, trace: Trace) -> GyrocompassFit:
    """Fit the declared model with what was found.

    What was scanned for counts as fitted: the change of each form with its scanned value is a column of its own.
    """
    found, table = trace.found, table.with_components(trace.components)
    places = slices([item.form.columns.shape[1] for item in found])
    first = table.fit(trace.forms, trace.noise).theta[table.model.parameters :]
    changes = [tangent(table.scene, item, first[place]) for item, place in zip(found, places, strict=True)]
    columns = [*(item.form.columns for item in found), *(change for change in changes if change is not None)]
    return _solved(table, trace, columns, places, changes)


def _solved(
    table: GyrocompassTable,
    trace: Trace,
    columns: Sequence[FloatArray],
    places: Sequence[slice],
    changes: Sequence[FloatArray | None],
) -> GyrocompassFit:
    noise, root, size = trace.noise, np.sqrt(table.weights), table.model.parameters
    theta = table.fit([Form(columns=each) for each in columns], noise).theta
    whole = np.column_stack([table.declared, *columns])
    misfit = table.output - whole @ table.model.coefficients(theta)
    whiten = table.memory.whitening(noise)
    residual = np.asarray(whiten(whiten(misfit * root)) / root)  # best linear unbiased prediction (Henderson 1975)
    compressed = compress(whole, table.output, table.weights, whiten)
    slopes = table.model.slopes(theta)
    jacobian = whiten(np.column_stack([table.declared @ slopes, *columns]) * root[:, None])
    inverse, _ = pseudo_inverse(jacobian)
    variance, freedom = _ruler(table, float(np.sum(whiten(misfit * root) ** 2)), table.rows - jacobian.shape[1])
    together = variance * inverse @ inverse.T
    numbers = iter(range(places[-1].stop if places else 0, len(theta) - size))
    to_degrees = np.array([np.rad2deg(1.0), 1.0])
    return GyrocompassFit(
        found=trace.found,
        columns=tuple(places),
        scanned=tuple(None if change is None else next(numbers) for change in changes),
        coefficients=theta[size:],
        covariance=together[size:, size:],
        residual=residual,
        dwell=float(np.sqrt(variance)),
        theta=theta[:size],
        parameter_covariance=together[:STATED, :STATED] * np.outer(to_degrees, to_degrees),
        identified=_identified(jacobian),
        degrees_of_freedom=freedom,
        compressed=compressed,
        inverse=pseudo_inverse(_stepped(compressed.r, slopes))[0],
        drawn=misfit - residual,
        everything=theta,
    )


def _ruler(table: GyrocompassTable, squares: float, freedom: int) -> tuple[float, int]:
    """Variance of a row of weight 1 with its degrees of freedom: by what is left, or by the samples of the dwells.

    Few rows are a poor ruler; what is within their dwells may be less than what is between them, and never says more.
    """
    left = squares / max(freedom, 1)
    known = variance_by_samples(table.observations) if freedom < _FEW else None
    if known is None or known < left:
        return left, max(freedom, 1)
    samples = table.observations.samples
    return known, freedom if samples is None else int(np.sum(samples - 1))


def _stepped(r: FloatArray, slopes: FloatArray) -> FloatArray:
    """What a step of all parameters does to compressed rows."""
    functions = len(slopes)
    return np.column_stack([r[:, :functions] @ slopes, r[:, functions:]])


def _identified(jacobian: FloatArray) -> NDArray[np.bool_]:
    """Which of α0 and the drift have no part in directions that no row sees."""
    norm = np.linalg.norm(jacobian, axis=0)
    scaled = jacobian / np.where(norm > 0, norm, 1.0)
    _, values, vectors = np.linalg.svd(scaled, full_matrices=True)
    rank = int(np.sum(values > 1e-8 * values[0]))
    return np.asarray(np.linalg.norm(vectors[rank:, :STATED], axis=0) < _SEEN)
