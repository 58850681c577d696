"""Hysteresis of the unit: a play between ax and the output, independent of rate (effects.md, `hysteresis`).

Within the play's width the output keeps what the last approach left it; beyond, it follows. The way of the head from
dwell to dwell counts, not only its ends; a unit that was just mounted has no past but the last of its way.
"""

from typing import Final

import numpy as np

from benchmarks.blind.geometry import FloatArray, projections
from benchmarks.blind.world import World

WIDTH_G: Final = 0.03
"""Way of ax over which the output goes from one branch to the other half way."""
_APPROACH_DEG: Final = 10.0
_POINTS: Final = 24


def lag(world: World) -> FloatArray:
    """Return -1 where ax rose on the way there, 1 where it fell, between where it did not go far, shape (rows,)."""
    way_g = _ways_g(world)
    state, states = 0.0, np.empty(len(way_g))
    for row, (steps_g, follows) in enumerate(zip(np.diff(way_g, axis=1), world.run.follows, strict=True)):
        state = state if follows else 0.0
        for step_g in steps_g:
            state = min(max(state + step_g / WIDTH_G, -1.0), 1.0)
        states[row] = -state
    return states


def _ways_g(world: World) -> FloatArray:
    """Return ax along the way to each dwell, shape (rows, points)."""
    run = world.run
    before_deg = np.where(run.follows, np.roll(run.angle_deg, 1), run.angle_deg - _APPROACH_DEG * run.direction)
    part = np.linspace(0.0, 1.0, _POINTS)
    way_deg = before_deg[:, None] + (run.angle_deg - before_deg)[:, None] * part
    true_deg = way_deg + world.unit.alpha0_deg + world.angle_error_deg[:, None]
    gravity = projections(np.repeat(run.mount, _POINTS), true_deg.reshape(-1), np.repeat(world.tilt_deg, _POINTS))
    return gravity[:, 0].reshape(len(run.time_s), _POINTS)
