"""How forward and backward passes over the same angles differ: what operators see first."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.scene import HeadScene

_BIN_DEG = 5.0
_MOVING_DEG_S = 0.5
"""A head that turns more slowly is taken as at rest."""


@dataclass(frozen=True, kw_only=True)
class Passes:
    """Forward minus backward at the same angles, before and after what was found is taken off."""

    before_deg: float
    """Root mean square."""
    after_deg: float
    angles: int
    """At how many angles both were seen."""


def passes(scene: HeadScene, before: FloatArray, after: FloatArray) -> Passes | None:
    """Compare residuals of the declared model and of the augmented one, shape (rows,), between the two directions."""
    moving = scene.direction != 0
    if scene.velocity_deg_s is not None and np.abs(scene.velocity_deg_s).max() > _MOVING_DEG_S:
        moving &= np.abs(scene.velocity_deg_s) > _MOVING_DEG_S
    place = np.floor(scene.angle_deg / _BIN_DEG).astype(np.int64)
    forward, backward = moving & (scene.direction > 0), moving & (scene.direction < 0)
    shared = np.intersect1d(place[forward], place[backward])
    if not len(shared):
        return None
    return Passes(
        before_deg=_difference(before, place, forward, backward, shared),
        after_deg=_difference(after, place, forward, backward, shared),
        angles=len(shared),
    )


def _difference(
    residual: FloatArray,
    place: NDArray[np.int64],
    forward: NDArray[np.bool_],
    backward: NDArray[np.bool_],
    shared: NDArray[np.int64],
) -> float:
    apart = [residual[forward & (place == at)].mean() - residual[backward & (place == at)].mean() for at in shared]
    return float(np.sqrt(np.mean(np.square(apart))))
