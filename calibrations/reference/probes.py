"""Experiments with a head and its reference, as the rows that they would add."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.geometry import FloatArray
from tumble.calibrations.observations import ARRAY_COLUMNS, Observations

_REST_S = 2.0
_MOVE_DEG_S = 20.0


@dataclass(frozen=True, kw_only=True)
class Motion:
    """Where the head would be when, shape (rows,) each."""

    angle_deg: FloatArray
    velocity_deg_s: FloatArray
    step_s: FloatArray
    """Time from each row to the next."""


@dataclass(frozen=True, kw_only=True)
class HeadProbe:
    """One experiment."""

    name: str
    does: str
    """In words that follow `measure`."""
    motion: Callable[[Observations], Motion]
    """For a table that is there."""
    wait_s: float = 0.0

    def stand_time_s(self, before: Observations) -> float:
        """Time that it takes."""
        return float(self.wait_s + self.motion(before).step_s.sum())

    def rows(self, before: Observations) -> Observations:
        """The rows that it would add after a table; what it says nothing of stays as it was in the last row."""
        motion = self.motion(before)
        count = len(motion.angle_deg)
        columns: dict[str, Any] = {
            name: None if (column := getattr(before, name)) is None else np.repeat(column[-1:], count)
            for name in ARRAY_COLUMNS
        }
        columns["row"] = before.row.max() + np.arange(1, count + 1)
        columns["angle_deg"] = motion.angle_deg
        columns["velocity_deg_s"] = motion.velocity_deg_s
        if before.time_s is not None:
            columns["time_s"] = before.time_s[-1] + self.wait_s + np.cumsum(motion.step_s)
        if before.direction is not None:
            columns["direction"] = _directions(motion)
        extra: dict[str, Any] = {name: np.repeat(column[-1:], count) for name, column in before.extra.items()}
        return replace(before, **columns, extra=extra, set_aside=())


def _directions(motion: Motion) -> FloatArray:
    moved = np.diff(motion.angle_deg, prepend=motion.angle_deg[0] - 1.0)
    return np.asarray(np.sign(moved).astype(np.int64))


def _rests(step_deg: float) -> Callable[[Observations], Motion]:
    """Rests all round the turn, there and back."""

    def motion(_: Observations) -> Motion:
        up = np.arange(0.0, 360.0 + step_deg / 2, step_deg)
        angle_deg = np.concatenate([up, up[-2::-1]])
        step_s = np.abs(np.diff(angle_deg, prepend=0.0)) / _MOVE_DEG_S + _REST_S
        return Motion(angle_deg=angle_deg, velocity_deg_s=np.zeros(len(angle_deg)), step_s=step_s)

    return motion


def _passes(part: float, turns: float) -> Callable[[Observations], Motion]:
    """There and back at a part of the greatest speed that the table has."""

    def motion(before: Observations) -> Motion:
        speeds = before.velocity_deg_s
        fastest = _MOVE_DEG_S if speeds is None or not speeds.any() else float(np.abs(speeds).max())
        speed = part * fastest
        up = np.arange(0.0, 360.0 * turns + 0.1, 2.0)
        velocity = np.repeat([speed, -speed], len(up))
        step_s = np.full(2 * len(up), 2.0 / speed)
        return Motion(angle_deg=np.concatenate([up, up[::-1]]), velocity_deg_s=velocity, step_s=step_s)

    return motion


PROBES: Final = (
    HeadProbe(
        name="rests",
        does="rests every 15° round the turn, each reached from both sides: at rest nothing is late",
        motion=_rests(15.0),
    ),
    HeadProbe(
        name="slow passes",
        does="passes there and back at a third of the speed: what is late is late by a third",
        motion=_passes(1 / 3, 1.0),
    ),
    HeadProbe(
        name="two turns",
        does="two turns there and back: what comes back with the circle comes back, what adds up does not",
        motion=_passes(1.0, 2.0),
    ),
    HeadProbe(
        name="fine rests",
        does="rests every 2°, reached from both sides: waves of any order are seen as what they are",
        motion=_rests(2.0),
    ),
    HeadProbe(
        name="rests later",
        does="rests every 15° round the turn an hour later: what drifts has drifted",
        motion=_rests(15.0),
        wait_s=3600.0,
    ),
)
"""All of them, the quickest first."""
