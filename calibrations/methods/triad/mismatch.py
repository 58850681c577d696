"""Mismatch |a| - 1 by position, before and with what was found."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.loop import TriadLoop


@dataclass(frozen=True, kw_only=True)
class PositionMismatch:
    """What each position leaves, in the order in which they were first taken; arrays of shape (positions,)."""

    outer_deg: FloatArray
    inner_deg: FloatArray
    dwells: NDArray[np.int64]
    before_arcsec: FloatArray
    """Mean over the dwells of the position, by the declared model."""
    after_arcsec: FloatArray
    """The same with what was found."""


def dwell_mismatch(loop: TriadLoop) -> tuple[FloatArray, FloatArray]:
    """Of each dwell before and after, in arc seconds of the local gravity."""
    outputs_v = loop.observations.outputs_v
    return loop.before.mismatch_arcsec(outputs_v), loop.best.mismatch_arcsec(outputs_v - loop.explained_v)


def position_mismatch(loop: TriadLoop) -> PositionMismatch:
    """The means by position."""
    rows = loop.observations
    _, first, number = np.unique(rows.positions, return_index=True, return_inverse=True)
    dwells = np.bincount(number)
    before, after = (np.bincount(number, weights=each) / dwells for each in dwell_mismatch(loop))
    order = np.argsort(first)
    return PositionMismatch(
        outer_deg=rows.outer_deg[first][order],
        inner_deg=rows.inner_deg[first][order],
        dwells=dwells[order],
        before_arcsec=before[order],
        after_arcsec=after[order],
    )
