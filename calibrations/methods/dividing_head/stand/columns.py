"""What the terms of a stand record add to the output of an accelerometer."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects.daq import DAQ_EFFECTS
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.effects.stand import STAND_EFFECTS
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.head_map import harmonics
from tumble.calibrations.stand_records.terms import BACKLASH, Term
from tumble.calibrations.tracing.effect import Effect

_CATALOGUE: Final[Mapping[str, Effect[Scene]]] = {effect.name: effect for effect in (*STAND_EFFECTS, *DAQ_EFFECTS)}


def columns_v(term: Term, scene: Scene) -> FloatArray:
    """Volts per unit of each coefficient, shape (rows, size)."""
    if term.effect == BACKLASH:
        return np.asarray((scene.slope_v_per_deg * (scene.direction < 0))[:, None])
    if term.of_angle:
        return np.asarray(scene.slope_v_per_deg[:, None] * harmonics(scene.angle_deg, term.orders))
    effect = _CATALOGUE[term.effect]
    if effect.at is None:
        return effect.forms(scene)[0].columns
    (value,) = term.scanned.values()
    return effect.at(scene, value).columns


def tangent_v(term: Term, scene: Scene, coefficients: FloatArray) -> FloatArray | None:
    """Change with what is scanned, shape (rows, 1), in volts per volt; None where nothing is, or it jumps."""
    if term.effect != "daq_nonlinearity":
        return None
    (value,) = term.scanned.values()
    step_v = 1e-3 * value
    above, below = (_CATALOGUE[term.effect].at(scene, value + side * step_v) for side in (1.0, -1.0))  # type: ignore[misc]
    return np.asarray(((above.columns - below.columns) @ coefficients / (2 * step_v))[:, None])


def corrections_columns_v(corrections: Corrections, scene: Scene) -> FloatArray:
    """Volts per unit of each coefficient, shape (rows, coefficients)."""
    return np.column_stack([columns_v(term, scene) for term in corrections.terms])


def corrections_voltage_v(corrections: Corrections, scene: Scene) -> FloatArray:
    """What all terms but those of the angle add to the output, shape (rows,)."""
    added = [
        columns_v(term, scene) @ corrections.values[corrections.place(term)]
        for term in corrections.terms
        if not term.of_angle
    ]
    return np.asarray(sum(added, start=np.zeros(len(scene.observations))))
