"""How visible an effect is: noise units beside the declared model (effects.md, last paragraph)."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run
from benchmarks.blind.world import Acts, Effect, Unit, World, respond_v

Family = Callable[[float], Effect]
"""An effect whose form is drawn, by its size."""

Draw = Callable[[Run, Unit, np.random.Generator], Family]
"""Draws the form of an effect for a run."""

_STEP_DEG: Final = 1e-4
_NEGLIGIBLE: Final = 1e-9
_CLOSE: Final = 1e-3
_TRIES: Final = 12


class CannotShowError(Exception):
    """The design cannot show an effect in the size that is asked for."""


def world_of(run: Run, unit: Unit) -> World:
    """Return the run as it is without any effect."""
    none = np.zeros(len(run.time_s))
    return World(run, unit, none, none, none)


def slope_v_deg(run: Run, unit: Unit) -> FloatArray:
    """Return du/dα of the declared model."""
    none = np.zeros(len(run.time_s))
    after, before = (
        unit.response_v(World(run, unit, none + step, none, none).gravity) for step in (_STEP_DEG, -_STEP_DEG)
    )
    return (after - before) / (2.0 * _STEP_DEG)


def declared(run: Run, unit: Unit) -> FloatArray:
    """Return the derivatives by u0, kx, ky, kz, kxy, alpha0 at the truth, shape (rows, 6)."""
    ax, ay, az = world_of(run, unit).gravity.T
    return np.column_stack([np.ones(len(ax)), ax, ay, az, ax * ay, slope_v_deg(run, unit)])


def beside(signals: FloatArray, columns: FloatArray) -> FloatArray:
    """Return what is left of signals orthogonally to columns."""
    if not columns.shape[1]:
        return signals
    scaled = columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    left, sizes, _ = np.linalg.svd(scaled, full_matrices=False)
    span = left[:, sizes > _NEGLIGIBLE * sizes[0]]
    return signals - span @ (span.T @ signals)


def whitened(values: FloatArray, run: Run) -> FloatArray:
    """Return the rows of the table, each over its standard deviation."""
    held = ~run.fresh
    return (values[held].T / run.noise_v[held]).T


def signal_v(run: Run, unit: Unit, effects: Sequence[Effect]) -> FloatArray:
    """Return what effects change in the noise-free readings."""
    return respond_v(run, unit, effects) - respond_v(run, unit)


def visible_units(run: Run, unit: Unit, effects: Sequence[Effect], columns: FloatArray | None = None) -> float:
    """Return the noise units of effects beside the declared model and further columns (whitened already)."""
    model = whitened(declared(run, unit), run)
    model = model if columns is None else np.column_stack([model, columns])
    return float(np.linalg.norm(beside(whitened(signal_v(run, unit, effects), run), model)))


def sized(family: Family, run: Run, unit: Unit, units: float) -> Effect:
    """Return the effect in the size that is visible with so many noise units.

    Raises
    ------
    CannotShowError
        Where no size within what is physical does it.
    """
    size = 1e-5
    for _ in range(_TRIES):
        effect = family(size)
        seen = visible_units(run, unit, [effect])
        if not 1e-6 < seen < np.inf:
            break
        if abs(seen / units - 1.0) < _CLOSE:
            return _physical(effect, run, unit)
        size *= min(units / seen, 1e3)
    raise CannotShowError(f"{family(size).name}: this design does not show it with {units:g} noise units")


_LARGEST: Final = {Acts.TILT: 1.0, Acts.ANGLE: 0.3, Acts.OUTPUT: 0.03, Acts.READING: 0.03}
_LARGEST_V_G2: Final = 5e-3
"""Of the nonlinear coefficients: five times the published kxy (domain.md, section 1)."""


def _physical(effect: Effect, run: Run, unit: Unit) -> Effect:
    """Refuse what would be larger than any stand or unit would let pass."""
    of_angle = effect.acts in (Acts.TILT, Acts.ANGLE)
    amount = effect.amount(world_of(run, unit)) if of_angle else signal_v(run, unit, [effect])
    largest = np.abs(amount).max()
    nonlinear = abs(effect.coefficients.get(effect.name, 0.0)) if effect.name.startswith("k_") else 0.0
    if largest > _LARGEST[effect.acts] or nonlinear > _LARGEST_V_G2:
        raise CannotShowError(f"{effect.name}: it would have to be larger than is physical to be seen")
    return effect
