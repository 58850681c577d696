"""Errors of the turntable as terms of a stand record: those of the angle of a positioner."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.stand_records.head_map import harmonics
from tumble.calibrations.stand_records.terms import BACKLASH, Term, harmonic_term
from tumble.calibrations.tracing.findings import EffectFound

_ORDERS: Final[Mapping[str, int]] = {"pickoff_eccentricity": 1, "pickoff_second_harmonic": 2}
_GRADUATION: Final = "pickoff_graduation"
_BACKLASH: Final = "backlash"
LASTING: Final = (*_ORDERS, _GRADUATION, _BACKLASH)
"""Effects that stay with a turntable; a scale of the angle is a matter of its counts, and a base turns in one run."""


def term_of(effect: EffectFound) -> Term:
    """The term of one of these effects."""
    if effect.name == _BACKLASH:
        return Term(effect=BACKLASH)
    order = effect.coefficients["order"].value if effect.name == _GRADUATION else _ORDERS[effect.name]
    return harmonic_term(round(order))


def columns(terms: Sequence[Term], scene: GyrocompassScene) -> FloatArray:
    """What a unit of each coefficient, a degree, adds to the rows, shape (rows, coefficients)."""
    found = [_angles_deg(term, scene) for term in terms]
    together = np.concatenate(found, axis=1) if found else np.empty((scene.dwells, 0))
    return np.column_stack([scene.turned(np.deg2rad(each)) for each in together.T]) if found else _nothing(scene)


def _nothing(scene: GyrocompassScene) -> FloatArray:
    return np.empty((scene.rows, 0))


def _angles_deg(term: Term, scene: GyrocompassScene) -> FloatArray:
    """True minus reported angle for a unit of each coefficient, shape (dwells, coefficients)."""
    if term.orders:
        return harmonics(scene.observations.azimuth_deg, term.orders)
    return (scene.direction < 0).astype(float)[:, None]
