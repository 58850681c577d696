"""Hysteresis of the unit along the true path of ax, dwells and turning points between them included.

Three forms with half gap 1: a play, a smooth approach after each reversal, and two plays at once. All lag: lower
after ax rose, higher after it fell. (A lens that closes at full input is no fourth: along one axis of rotation it is
backlash to the last digit, since both follow the slope and the direction of approach.)
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from benchmarks.bank.dwells import IntArray
from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import Effect, OutputEffect, Run, Scene

Loop = Callable[[FloatArray], FloatArray]
"""From ax along the path to the deviation from the middle of the loop, in half gaps."""


def drawn_hysteresis(rng: np.random.Generator, _: Run) -> Effect:
    """Draw the form of the loop and its width."""
    shape, loop = (
        ("play", partial(_play, width_g=float(rng.uniform(0.02, 0.15)))),
        ("approach", partial(_approach, width_g=float(rng.uniform(0.02, 0.15)))),
        ("two plays", partial(_two_plays, width_g=float(rng.uniform(0.02, 0.08)))),
    )[rng.integers(3)]

    def added_v(scene: Scene, amplitude: float) -> FloatArray:
        ax, ends = path(scene)
        return amplitude * loop(ax)[ends]

    return OutputEffect(name="hysteresis", shape=shape, sign=1.0 if rng.uniform() < 0.75 else -1.0, added_v=added_v)


def path(scene: Scene) -> tuple[FloatArray, IntArray]:
    """Return ax along the way of the head, and where on it each row lies.

    Between two dwells ax can only turn at a multiple of 90°, so the way holds every one that is passed. A change of
    mount passes none: how the hand turns the unit is not known.
    """
    angle = scene.angle_deg
    before = np.concatenate([[angle[0] - 1.0], angle[:-1]])
    before[1:] = np.where(np.diff(scene.run.dwells.mounting) > 0, angle[1:], before[1:])
    rising = angle >= before
    sign = np.where(rising, 1, -1)
    first = np.where(rising, np.floor(before / 90.0) + 1.0, np.ceil(before / 90.0) - 1.0)
    last = np.where(rising, np.ceil(angle / 90.0) - 1.0, np.floor(angle / 90.0) + 1.0)
    passed = np.maximum(sign * (last - first) + 1, 0).astype(np.int64)
    ends = np.cumsum(passed + 1) - 1
    owner = np.repeat(np.arange(len(angle)), passed + 1)
    step = np.arange(len(owner)) - (ends - passed)[owner]
    way_deg = np.where(step < passed[owner], 90.0 * (first[owner] + sign[owner] * step), angle[owner])
    axis = scene.run.dwells.axes[owner, 0]
    way = np.deg2rad(way_deg)
    ax = -np.sin(way) * axis[:, 0] - np.cos(way) * axis[:, 1]
    ax[ends] = scene.gravity[:, 0]
    return ax, ends


def _play(ax: FloatArray, width_g: float) -> FloatArray:
    """A contact with slack: it is dragged along at a distance of `width_g`."""
    contact, deviation = float(ax[0]), []
    for value in ax.tolist():
        if contact < value - width_g:
            contact = value - width_g
        elif contact > value + width_g:
            contact = value + width_g
        deviation.append((contact - value) / width_g)
    return np.array(deviation)


def _approach(ax: FloatArray, width_g: float) -> FloatArray:
    """After a reversal the branch is reached as 1 - exp(-way / `width_g`)."""
    step = np.diff(ax, prepend=ax[0])
    kept = np.exp(-np.abs(step) / width_g)
    branch, deviation, value = -np.sign(step), [], 0.0
    for goal, part in zip(branch.tolist(), kept.tolist(), strict=True):
        value = goal + (value - goal) * part
        deviation.append(value)
    return np.array(deviation)


def _two_plays(ax: FloatArray, width_g: float) -> FloatArray:
    """Half of the gap taken up within one width, half within three."""
    return np.asarray((_play(ax, width_g=width_g) + _play(ax, width_g=3 * width_g)) / 2)
