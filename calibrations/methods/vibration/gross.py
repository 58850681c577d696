"""Gross errors: dwells of which no coefficients near those of all others explain the output."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import BoolArray, FloatArray
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.core.solutions import smallest_solution
from tumble.calibrations.methods.vibration.table import VibrationTable, settings
from tumble.messages import Message

_HUBER: Final = 1.345
"""Tuning of Huber's weights: 95% efficient on normal noise (Huber and Ronchetti, Robust Statistics, 4.5)."""
_ROUNDS: Final = 40
_SEVERAL: Final = 3
"""Dwells in a run that are no accident."""
_MUCH: Final = 0.3
"""Relative difference within which they are much the same."""


def gross_errors(table: VibrationTable) -> tuple[SetAside, ...]:
    """Dwells to set aside.

    Where a setting was visited more than once, a dwell must also differ as much from the median of the other visits:
    what comes back at every visit is no gross error but structure. So is what stays: several dwells, one after the
    other, that are off by much the same.
    """
    weighted = _robust_residual(table)
    spare = max(table.rows - int(np.linalg.matrix_rank(table.declared)), 1)
    scale = max(float(1.4826 * np.median(np.abs(weighted)) * np.sqrt(table.rows / spare)), 1e-12)
    limit = gross_sigmas(spare) * scale
    setting = settings(table.scene)
    off = np.abs(weighted) > limit
    off &= ~_lasting(weighted, off, scale)
    return tuple(
        SetAside(
            row=int(table.observations.row[dwell]),
            reason=Message("gross error: {sigmas:.0f} sigma", sigmas=abs(weighted[dwell]) / scale),
            gross=True,
        )
        for dwell in np.flatnonzero(off).tolist()
        if _differs_from_repeats(weighted, setting == setting[dwell], dwell, limit)
    )


def _lasting(weighted: FloatArray, off: BoolArray, scale: float) -> BoolArray:
    """Which rows belong to a run of several that are off in one sense by much the same, shape (rows,)."""
    lasting = np.zeros(len(off), dtype=bool)
    side = np.sign(weighted) * off
    for members in np.split(np.arange(len(off)), np.flatnonzero(np.diff(side)) + 1):
        if off[members[0]] and len(members) >= _SEVERAL:
            typical = float(np.median(weighted[members]))
            lasting[members] = np.median(np.abs(weighted[members] - typical)) < max(_MUCH * abs(typical), 2.0 * scale)
    return lasting


def _robust_residual(table: VibrationTable) -> FloatArray:
    """Residuals of Huber's M-estimate, in standard deviations of their rows but for a factor, shape (rows,)."""
    root = np.sqrt(table.weights)
    columns, output = table.declared * root[:, None], table.output * root
    robust = np.ones(table.rows)
    residual = output
    for _ in range(_ROUNDS):
        theta = smallest_solution(columns * robust[:, None], output * robust)
        residual = output - columns @ theta
        limit = _HUBER * max(float(1.4826 * np.median(np.abs(residual))), 1e-12)
        previous, robust = robust, np.sqrt(np.minimum(1.0, limit / np.maximum(np.abs(residual), limit)))
        if np.abs(robust - previous).max(initial=0.0) < 1e-3:
            break
    return np.asarray(residual)


def _differs_from_repeats(weighted: FloatArray, alike: BoolArray, dwell: int, limit: float) -> bool:
    others = np.flatnonzero(alike)
    others = others[others != dwell]
    return not len(others) or bool(abs(weighted[dwell] - np.median(weighted[others])) > limit)
