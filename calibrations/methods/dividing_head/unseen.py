"""Effects that a table cannot show: what one of them, undeclared, could add to the parameters without a trace.

The output that a calibration predicts is fitted again with an effect taken off it. Of each effect the largest size is
taken that leaves less than `VISIBLE` noise units which the declared model does not follow, and no more than an
accelerometer and a stand of this kind have at most.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed, compress
from tumble.calibrations.methods.dividing_head.best_alpha0 import quick_parameters
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.fit import fit_given_alpha0, squares_v2
from tumble.calibrations.methods.dividing_head.loop.table import scene_of
from tumble.calibrations.methods.dividing_head.model import ALPHA0, PARAMETERS, basis, coefficients
from tumble.calibrations.methods.dividing_head.result import Calibration

VISIBLE: Final = 4.8
"""What an effect must leave, in noise units of a dwell over all rows, to be found."""
MATERIAL: Final = 2 * VISIBLE
"""In standard uncertainties of a parameter: what is barely seen moves it by up to `VISIBLE` of them, whatever it is."""
_SHARE: Final = 1e-2
"""The largest terms of second and third order, as a share of the response to 1 g."""
_LARGEST: Final[Mapping[str, float]] = {"head_eccentricity": 0.1, "head_second_harmonic": 0.1, "axis_tilt": 0.5}
"""The largest errors of a stand, in degrees."""
_OF_THE_UNIT: Final = ("k_xx", "k_yy", "k_zz", "k_xz", "k_yz", "k_xxx", "scale_asymmetry")
_HALVINGS: Final = 10
_CURVED_DEG: Final = 1.0
"""An effect that moves alpha0 by more moves the other parameters not in proportion: smaller ones are tried too."""
_PARTS: Final = (0.5, 0.25)


@dataclass(frozen=True, kw_only=True)
class Unseen:
    """One effect that the rows could hide, and where the parameters would be with it."""

    effect: str
    parameters: Mapping[str, float]
    """Value of every parameter by name once the effect is taken off the output."""


def unseen(calibration: Calibration) -> tuple[Unseen, ...]:
    """Every effect of the pose, at the largest size that the rows could hide, of either sign."""
    return tuple(found for name in (*_OF_THE_UNIT, *_LARGEST) for found in _of(calibration, name))


def _of(calibration: Calibration, name: str) -> Iterator[Unseen]:
    theta = _theta(calibration)
    linearised_at = theta.copy()
    if calibration.parameters["alpha0"].rests_on:
        linearised_at[ALPHA0] = 0.0  # nearer the truth than what a hidden effect may have made of it
    largest = _LARGEST.get(name, _SHARE * float(np.linalg.norm(theta[1:4])))
    effect = next(each for each in CATALOGUE if each.name == name)
    functions = basis(calibration.observations)
    for form in effect.forms(scene_of(calibration.observations, linearised_at)):
        for column in form.columns.T:
            added = compress(functions, column, calibration.weights)
            for size in (largest, -largest):
                for moved in _moves(calibration, theta, added, size):
                    yield Unseen(effect=name, parameters=dict(zip(PARAMETERS, (theta + moved).tolist(), strict=True)))


def _moves(calibration: Calibration, theta: FloatArray, added: Compressed, size: float) -> Iterator[FloatArray]:
    """How far an effect moves the parameters, at its largest and, where that is not in proportion, at parts of it."""
    largest = _moved(calibration, theta, added, size)
    yield largest
    if abs(largest[ALPHA0]) > _CURVED_DEG:
        yield from (_moved(calibration, theta, added, part * size) for part in _PARTS)


def _moved(calibration: Calibration, theta: FloatArray, added: Compressed, size: float) -> FloatArray:
    """How far an effect of that size, `added` at size 1, moves the parameters, reduced until rows would not show it."""
    identifiable = calibration.parameters["alpha0"].value is not None
    predicted_v, noise_v = added.r @ coefficients(theta), calibration.noise.used_v
    for _ in range(_HALVINGS):
        outside = abs(size) * np.sqrt(max(added.rest_v2, 0.0)) / noise_v  # what no parameters at all would follow
        if outside > VISIBLE:
            size *= min(0.5, VISIBLE / outside)
            continue
        compressed = replace(added, z=predicted_v + size * added.z, rest_v2=size**2 * added.rest_v2)
        held = None if identifiable else fit_given_alpha0(compressed, float(theta[ALPHA0])).theta
        moved = quick_parameters(compressed) if held is None else held
        if np.sqrt(max(squares_v2(compressed, moved), 0.0)) / noise_v <= VISIBLE:
            return np.asarray(moved - theta)
        size *= 0.5
    return np.zeros_like(theta)


def _theta(calibration: Calibration) -> FloatArray:
    return np.array([parameter.value or 0.0 for parameter in calibration.parameters.values()])
