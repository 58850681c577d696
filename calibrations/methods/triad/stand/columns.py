"""What the terms of a stand record add to the outputs of a triad."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.effects.daq import DAQ_EFFECTS
from tumble.calibrations.methods.triad.effects.stand import STAND_EFFECTS
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.terms import DAQ_NONLINEARITY, RANGE_STEP, TWO_AXES, Term
from tumble.calibrations.tracing.effect import Effect, Form

_CATALOGUE: Final[Mapping[str, Effect[TriadScene]]] = {each.name: each for each in (*STAND_EFFECTS, *DAQ_EFFECTS)}
LASTING: Final = (*TWO_AXES, DAQ_NONLINEARITY, RANGE_STEP)
"""Effects that stay with a stand; a leaning base or a settling belongs to the run."""


def form_of(term: Term, scene: TriadScene) -> Form | None:
    """Volts per unit of each coefficient; None where these positions do not show it."""
    effect = _CATALOGUE[term.effect]
    if effect.at is not None and term.scanned:
        (value,) = term.scanned.values()
        return effect.at(scene, value)
    return next(iter(effect.forms(scene)), None)


def columns_v(corrections: Corrections, scene: TriadScene) -> FloatArray:
    """What a unit of each coefficient adds to the outputs, shape (rows, coefficients), in volts."""
    found = np.zeros((scene.rows, len(corrections.values)))
    for term in corrections.terms:
        form = form_of(term, scene)
        if form is not None:
            found[:, corrections.place(term)] = form.columns
    return found


def correction_v(corrections: Corrections, scene: TriadScene) -> FloatArray:
    """What all terms add to the outputs, shape (dwells, 3)."""
    return np.asarray((columns_v(corrections, scene) @ corrections.values).reshape(-1, 3))
