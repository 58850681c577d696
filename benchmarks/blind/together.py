"""Whether several named effects can be told apart in a run at all."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import CannotShowError, signal_v, slope_v_deg, visible_units, whitened
from benchmarks.blind.world import Effect, Unit

VISIBLE_UNITS: Final = 8.0
"""effects.md: below about 8 an honest method misses part."""
_COURSE: Final = 25


def check_together(effects: Sequence[Effect], run: Run, unit: Unit) -> None:
    """See that each effect is visible beside everything that the others could be.

    Raises
    ------
    CannotShowError
        Where one is not.
    """
    for effect in effects:
        others = [_freedom(other, run, unit) for other in effects if other is not effect]
        columns = whitened(np.column_stack(others), run) if others else None
        if visible_units(run, unit, [effect], columns) < VISIBLE_UNITS:
            raise CannotShowError(f"{effect.name}: not visible beside the others")


def _freedom(effect: Effect, run: Run, unit: Unit) -> FloatArray:
    """Columns that an effect could take with other coefficients, shape (rows, n)."""
    slope = slope_v_deg(run, unit)
    if effect.name == "seating":
        return _levels(run.seating) * slope[:, None]
    if effect.name == "realisation_bias":
        return _levels(run.realisation)
    if effect.name == "bias_random_walk":
        return _levels((run.time_s / run.time_s[-1] * (_COURSE - 1e-6)).astype(np.int64))
    if "phase_deg" in effect.coefficients:
        order = {"head_eccentricity": 1, "head_second_harmonic": 2}.get(effect.name) or effect.coefficients["order"]
        turn = np.radians(order * run.angle_deg)
        return np.column_stack([slope * np.sin(turn), slope * np.cos(turn)])
    return signal_v(run, unit, [effect])[:, None]


def _levels(group: np.ndarray[tuple[int], np.dtype[np.int64]]) -> FloatArray:
    return np.asarray(group[:, None] == np.unique(group), dtype=np.float64)
