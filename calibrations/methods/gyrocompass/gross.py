"""Gross errors of a gyrocompass: dwells that neither the earth rate nor their repeats explain, and wrong angles."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions
from tumble.calibrations.methods.gyrocompass.lean import leans
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.weights import rate_variances
from tumble.messages import Message

_HUBER: Final = 1.345
"""Tuning of Huber's weights: 95% efficient on normal noise (Huber and Ronchetti, Robust Statistics, 4.5)."""
_ROUNDS = 40
_UNKNOWNS = 3
_MOST_LEFT: Final = 0.1
"""Part of the dwells that may be gross errors."""
_ENOUGH_TILTS: Final = 8
"""Tilts of a base from which on one of them may be told to be wrong."""


@dataclass(frozen=True, kw_only=True)
class RobustFit:
    """Coefficients of sin α0, cos α0 and the drift, unbound to each other, that few rows cannot pull."""

    coefficients: FloatArray
    residual: FloatArray
    """Weighted, shape (rows,), in °/h."""
    scale: float
    """Robust standard deviation of the residual."""


def robust_fit(observations: GyrocompassObservations) -> RobustFit:
    """Huber's M-estimate."""
    design = np.column_stack(
        [
            heading_functions(np.deg2rad(observations.azimuth_deg), observations.latitude_deg, leans(observations)),
            np.ones(len(observations)),
        ]
    )
    root = 1.0 / np.sqrt(rate_variances(observations))
    white, output = design * root[:, None], observations.rate_deg_h * root
    residual, robust = output, np.ones(len(output))
    coefficients: FloatArray = np.zeros(_UNKNOWNS)
    for _ in range(_ROUNDS):
        each = np.sqrt(robust)
        coefficients = np.asarray(np.linalg.lstsq(white * each[:, None], output * each, rcond=1e-9)[0])
        residual = output - white @ coefficients
        limit = _HUBER * max(float(1.4826 * np.median(np.abs(residual))), 1e-12)
        robust = np.minimum(1.0, limit / np.maximum(np.abs(residual), limit))
    spare = max(len(output) - _UNKNOWNS, 1)
    scale = float(1.4826 * np.median(np.abs(residual)) * np.sqrt(len(output) / spare))
    return RobustFit(coefficients=coefficients, residual=residual, scale=max(scale, 1e-12))


def gross_errors(observations: GyrocompassObservations) -> tuple[SetAside, ...]:
    """Dwells to set aside.

    Where a position was visited more than once, a dwell must also differ as much from every other visit: what comes
    back is no gross error but structure.
    """
    fit = robust_fit(observations)
    found = dict(_far(observations, fit.residual / fit.scale, _of_rate))
    if (tilts := _tilts(observations)) is not None:
        found = dict(_far(observations, tilts, _of_tilt)) | found
    return tuple(found[row] for row in sorted(found))


def _of_rate(sigmas: float) -> Message:
    return Message("gross error: {sigmas:.0f} sigma", sigmas=sigmas)


def _of_tilt(sigmas: float) -> Message:
    return Message("gross error of the tilt: {sigmas:.0f} sigma", sigmas=sigmas)


_Reason: TypeAlias = Callable[[float], Message]


def _far(observations: GyrocompassObservations, sigmas: FloatArray, reason: _Reason) -> Iterator[tuple[int, SetAside]]:
    """Dwells that are too far off, by row; `sigmas` are residuals in robust standard deviations."""
    limit = gross_sigmas(len(observations) - _UNKNOWNS)
    for dwell in np.flatnonzero(np.abs(sigmas) > limit).tolist():
        if _differs_from_repeats(observations, sigmas, dwell, limit):
            row = int(observations.row[dwell])
            yield row, SetAside(row=row, reason=reason(abs(sigmas[dwell])), gross=True)


def _tilts(observations: GyrocompassObservations) -> FloatArray | None:
    """Tilts less the lean, in robust standard deviations; None where there are none, or too few to tell."""
    if observations.tilt_gamma_deg is None or len(observations) < _ENOUGH_TILTS * (observations.bases.max() + 1):
        return None
    tilt = np.sin(np.deg2rad(observations.tilt_gamma_deg))
    left = tilt - leans(observations).sin_tilt(np.deg2rad(observations.azimuth_deg))
    left = left - np.median(left)
    return np.asarray(left / max(float(1.4826 * np.median(np.abs(left))), 1e-9))


def _differs_from_repeats(
    observations: GyrocompassObservations, residual: FloatArray, dwell: int, limit: float
) -> bool:
    others = np.flatnonzero(observations.positions == observations.positions[dwell])
    others = others[others != dwell]
    return not len(others) or abs(float(np.min(np.abs(residual[dwell] - residual[others])))) > limit


def left_gross(observations: GyrocompassObservations, left: FloatArray) -> tuple[SetAside, ...]:
    """Dwells that stand out of what is left once a table was traced, shape (dwells, outputs), weighted.

    An effect may have hidden them. Where they are many, they are no gross errors.
    """
    scale = np.maximum(1.4826 * np.median(np.abs(left), axis=0), 1e-12)
    worst = np.abs(left / scale).max(axis=1)
    far = np.flatnonzero(worst > gross_sigmas(left.size))
    if len(far) > _MOST_LEFT * len(worst):
        return ()
    return tuple(
        SetAside(row=int(observations.row[dwell]), reason=_of_rate(float(worst[dwell])), gross=True)
        for dwell in far.tolist()
    )
