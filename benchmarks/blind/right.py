"""On what structure without a name truly depends, given the design, and that no catalogue effect is it."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.blind.geometry import FloatArray, IntArray
from benchmarks.blind.named import FORMS
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import beside, declared, slope_v_deg, whitened, world_of
from benchmarks.blind.world import Unit

COARSE: Final = {"unwrapped_angle": "angle", "pose": "acceleration", "time_since_seating": "time"}
"""`depends_on` of a finer variable (result.md)."""

PARTED_UNITS: Final = 4.8
"""result.md: right is any variable that the design parts from the true one by less."""
_SETTINGS: Final = 90
_CELL_G: Final = 0.1
_NOTHING: Final = 1e-9


def variables(run: Run, unit: Unit) -> dict[str, list[FloatArray]]:
    """Return the variables of result.md, each as the values that it may mean for each row."""
    gravity = world_of(run, unit).gravity
    cells = np.unique(np.round(gravity / _CELL_G), axis=0, return_inverse=True)[1].reshape(-1)
    one: dict[str, NDArray[np.generic]] = {
        "angle": np.mod(run.angle_deg, 360.0),
        "unwrapped_angle": run.angle_deg,
        "pose": cells,
        "time": run.time_s,
        "time_since_seating": run.since_seating_s,
        "temperature": run.temperature_degc,
        "direction": run.direction,
        "realisation": run.realisation,
        "order": run.place,
    }
    told = {name: [np.asarray(values, dtype=np.float64)] for name, values in one.items()}
    return told | {"acceleration": [np.round(axis, 6) for axis in gravity.T]}


def right_variables(effect_v: FloatArray, run: Run, unit: Unit) -> frozenset[str]:
    """Return the variables of which a function, in some channel, leaves less than 4.8 noise units of an effect."""
    model, effect = whitened(declared(run, unit), run), whitened(effect_v, run)
    gains = np.column_stack([np.ones(len(effect_v)), world_of(run, unit).ax, slope_v_deg(run, unit)]).T
    return frozenset(
        name
        for name, meant in variables(run, unit).items()
        if any(_left(effect, model, values, gain, run) < PARTED_UNITS for values in meant for gain in gains)
    )


def _left(effect: FloatArray, model: FloatArray, values: FloatArray, gain: FloatArray, run: Run) -> float:
    """Return what the model and a level for each setting leave: the levels are taken out first, row by row."""
    levels = _settings(values[~run.fresh])
    weight = whitened(gain, run)
    model_left, effect_left = _without_levels(model, levels, weight), _without_levels(effect[:, None], levels, weight)
    beyond = np.linalg.norm(model_left, axis=0) > _NOTHING * np.linalg.norm(model, axis=0)
    return float(np.linalg.norm(beside(effect_left[:, 0], model_left[:, beyond])))


def _settings(values: FloatArray) -> IntArray:
    """Number the distinct values, or as many quantiles as a course may have levels."""
    levels = np.unique(values, return_inverse=True)[1]
    if levels.max() < _SETTINGS:
        return levels
    return np.argsort(np.argsort(values, kind="stable"), kind="stable") * _SETTINGS // len(values)


def _without_levels(columns: FloatArray, levels: IntArray, weight: FloatArray) -> FloatArray:
    """Project columns orthogonally to a free level for each setting, each times a weight."""
    power = np.maximum(np.bincount(levels, weight**2), _NOTHING)
    means = np.column_stack([np.bincount(levels, weight * column) for column in columns.T]) / power[:, None]
    return np.asarray(columns - weight[:, None] * means[levels])


def beyond_catalogue_units(effect_v: FloatArray, run: Run, unit: Unit) -> float:
    """Return what all catalogue effects that are linear in their coefficients leave of an effect, taken together."""
    columns = np.column_stack([declared(run, unit), _catalogue(run, unit)])
    return float(np.linalg.norm(beside(whitened(effect_v, run), whitened(columns, run))))


def _catalogue(run: Run, unit: Unit) -> FloatArray:
    """Columns of effects.md: of the unit, the head's first two harmonics, play, and a base that leans."""
    world, slope = world_of(run, unit), slope_v_deg(run, unit)
    turn = np.radians(run.angle_deg)
    errors = [np.sin(turn), np.cos(turn), np.sin(2 * turn), np.cos(2 * turn), run.direction < 0, run.time_s]
    return np.column_stack([*(form(world) for form in FORMS.values()), *(slope * error for error in errors)])
