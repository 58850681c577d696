"""Experiments with a head and its reference, as the rows that they would add."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.joining import appended
from tumble.calibrations.methods.head_reference.observations import HeadObservations
from tumble.messages import Message

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
class HeadMotion:
    """One experiment: how the head is moved."""

    programme: str
    does: str
    motion: Motion
    wait_s: float = 0.0
    command: str = ""
    """Nothing here moves a head against its reference."""
    pairs: bool = False

    @property
    def stand_time_s(self) -> float:
        """Time that it takes."""
        return float(self.wait_s + self.motion.step_s.sum())

    def after(self, rows: HeadObservations) -> HeadObservations:
        """Return a table with the rows that it would add; what it says nothing of stays as it was in the last row."""
        return appended(rows, self._rows(rows))

    def _rows(self, before: HeadObservations) -> HeadObservations:
        motion, columns = self.motion, dict[str, Any]()
        count = len(motion.angle_deg)
        columns["row"] = before.row.max() + np.arange(1, count + 1)
        columns["angle_deg"] = motion.angle_deg
        columns["velocity_deg_s"] = motion.velocity_deg_s
        if before.time_s is not None:
            columns["time_s"] = before.time_s[-1] + self.wait_s + np.cumsum(motion.step_s)
        if before.direction is not None:
            columns["direction"] = _directions(motion)
        return replace(before.lasting(count), **columns)


def probes(before: HeadObservations) -> tuple[HeadMotion, ...]:
    """The experiments that may follow a table, the quickest first."""
    return (
        HeadMotion(
            programme=Message("rests"),
            does=Message("every 15° round the turn, each reached from both sides: at rest nothing is late"),
            motion=_rests(15.0),
        ),
        HeadMotion(
            programme=Message("slow passes"),
            does=Message("there and back at a third of the speed: what is late is late by a third"),
            motion=_passes(before, 1 / 3, 1.0),
        ),
        HeadMotion(
            programme=Message("two turns"),
            does=Message("there and back: what comes back with the circle comes back, what adds up does not"),
            motion=_passes(before, 1.0, 2.0),
        ),
        HeadMotion(
            programme=Message("fine rests"),
            does=Message("every 2°, reached from both sides: waves of any order are seen as what they are"),
            motion=_rests(2.0),
        ),
        HeadMotion(
            programme=Message("rests later"),
            does=Message("every 15° round the turn an hour later: what drifts has drifted"),
            motion=_rests(15.0),
            wait_s=3600.0,
        ),
    )


def _directions(motion: Motion) -> FloatArray:
    moved = np.diff(motion.angle_deg, prepend=motion.angle_deg[0] - 1.0)
    return np.asarray(np.sign(moved).astype(np.int64))


def _rests(step_deg: float) -> Motion:
    """Rests all round the turn, there and back."""
    up = np.arange(0.0, 360.0 + step_deg / 2, step_deg)
    angle_deg = np.concatenate([up, up[-2::-1]])
    step_s = np.abs(np.diff(angle_deg, prepend=0.0)) / _MOVE_DEG_S + _REST_S
    return Motion(angle_deg=angle_deg, velocity_deg_s=np.zeros(len(angle_deg)), step_s=step_s)


def _passes(before: HeadObservations, part: float, turns: float) -> Motion:
    """There and back at a part of the greatest speed that the table has."""
    speeds = before.velocity_deg_s
    fastest = _MOVE_DEG_S if speeds is None or not speeds.any() else float(np.abs(speeds).max())
    speed = part * fastest
    up = np.arange(0.0, 360.0 * turns + 0.1, 2.0)
    velocity = np.repeat([speed, -speed], len(up))
    step_s = np.full(2 * len(up), 2.0 / speed)
    return Motion(angle_deg=np.concatenate([up, up[::-1]]), velocity_deg_s=velocity, step_s=step_s)
