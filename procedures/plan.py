"""What a programme will do and how long it will take, worked out without moving anything."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.approach import Place, direction_of
from tumble.procedures.composition import advance
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Direction, Dwell, Mounted, Mounting, Point, Reply, Step

MOUNTING_S = 60.0
"""Time in which an operator seats a unit anew, unless it is stated."""


@dataclass(frozen=True, kw_only=True)
class PlannedStep:
    """A step and the time it should take, in seconds."""

    step: Step
    duration_s: float
    waypoints_deg: tuple[float, ...] = ()
    """Angles at which the head stops, the dwell's own the last of them; none for a mounting."""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Every step of a programme, as it would go with a nominal unit: 1 V/g on the x axis, no bias."""

    programme: Programme
    steps: tuple[PlannedStep, ...]

    @property
    def duration_s(self) -> float:
        """Time that the whole should take."""
        return sum(planned.duration_s for planned in self.steps)

    @property
    def dwells(self) -> int:
        """Number of dwells, and so of points."""
        return sum(isinstance(planned.step, Dwell) for planned in self.steps)

    @property
    def mount_changes(self) -> int:
        """How often the operator must seat the unit, the first time included."""
        return len(self.steps) - self.dwells

    @property
    def angle_range_deg(self) -> tuple[float, float]:
        """Lowest and highest head angle of a dwell."""
        angles_deg = [planned.step.angle_deg for planned in self.steps if isinstance(planned.step, Dwell)]
        return min(angles_deg), max(angles_deg)

    def steps_after(self, points: int) -> tuple[PlannedStep, ...]:
        """What is left to do once so many points are there."""
        ends = [number for number, planned in enumerate(self.steps, start=1) if isinstance(planned.step, Dwell)]
        return self.steps[ends[points - 1] :] if points else self.steps


def plan(
    programme: Programme,
    acquisition: Acquisition,
    *,
    speed_deg_s: float,
    mounting_s: float = MOUNTING_S,
    start_deg: float = 0.0,
) -> Plan:
    """Work out every step of `programme`.

    A dwell takes the moves from the angle before it at `speed_deg_s`, the settling where the first two blocks agree,
    and the samples; a mounting takes `mounting_s`. The head begins at `start_deg`.
    """
    procedure = programme.procedure()
    steps: list[PlannedStep] = []
    here, points = Place(angle_deg=start_deg, direction=0), 0
    step: Step | None = next(procedure)
    while step is not None:
        if isinstance(step, Mounting):
            steps.append(PlannedStep(step=step, duration_s=mounting_s))
        else:
            waypoints_deg = acquisition.approach.waypoints_deg(here, step.angle_deg, acquisition.position_tolerance_deg)
            stops_deg = (here.angle_deg, *waypoints_deg)
            move_s = sum(abs(second - first) for first, second in pairwise(stops_deg)) / speed_deg_s
            duration_s = move_s + acquisition.planned_settling_s + acquisition.dwell_s
            steps.append(PlannedStep(step=step, duration_s=duration_s, waypoints_deg=waypoints_deg))
            here, points = _arrived(stops_deg, here.direction), points + 1
        step = advance(procedure, _nominal_reply(step, points - 1))
    return Plan(programme=programme, steps=tuple(steps))


def check_limits(plan: Plan, limits_deg: tuple[float, float]) -> None:
    """Make sure that every dwell, and the way round to it, lies within the head's soft limits.

    Raises
    ------
    ProgrammeError
        Names file, line, angle and limits.
    """
    lowest_deg, highest_deg = limits_deg
    for planned in plan.steps:
        step = planned.step
        beyond_deg = [angle for angle in planned.waypoints_deg if not lowest_deg <= angle <= highest_deg]
        if isinstance(step, Dwell) and beyond_deg:
            way = "" if beyond_deg[-1] == step.angle_deg else f" on its way to {step.angle_deg:g} deg"
            raise ProgrammeError(
                f"{_origin(plan.programme, step)}: the {step.procedure} goes to {beyond_deg[-1]:g} deg{way}, outside "
                f"the head's limits of {lowest_deg:g} to {highest_deg:g} deg; change the angles, or the limits of the "
                "stand"
            )


def check_cable(plan: Plan, turns: float) -> None:
    """Make sure that the head, which begins unwound about its zero, never winds its cable further than it may.

    Raises
    ------
    ProgrammeError
        Names file, line, angle and turns.
    """
    for planned in plan.steps:
        step = planned.step
        if isinstance(step, Dwell) and max(map(abs, planned.waypoints_deg)) / 360.0 > turns:
            raise ProgrammeError(
                f"{_origin(plan.programme, step)}: the {step.procedure} goes to {step.angle_deg:g} deg, and the cable "
                f"allows {turns:g} turns to either side of zero; change the angles, or cable_turns of the stand"
            )


def check_mounts(plan: Plan, mounts: Collection[str] | None) -> None:
    """Make sure that the seat allows every mount; None allows all.

    Raises
    ------
    ProgrammeError
        Names file, line, mount and those that there are.
    """
    if mounts is None:
        return
    for planned in plan.steps:
        step = planned.step
        if isinstance(step, Dwell) and step.mount not in mounts:
            raise ProgrammeError(
                f"{_origin(plan.programme, step)}: the {step.procedure} needs the mount {step.mount}, and the seat "
                f"allows {', '.join(mounts)} only; change the mount, or mounts of the stand"
            )


def _origin(programme: Programme, dwell: Dwell) -> str:
    """File and line of the first procedure that asks for `dwell`."""
    for number, part in enumerate(programme.procedures):
        dwells = part.dwells(dwell.realisation)
        step = next(dwells, None)
        while step is not None and step != dwell:
            step = advance(dwells, _nominal_point(step, 0))
        if step == dwell:
            return programme.where(number)
    raise AssertionError(f"{dwell} is in no procedure of its own programme")


def _arrived(stops_deg: Sequence[float], direction: Direction) -> Place:
    """Where the head stands after its last move that was one."""
    ways_deg = [second - first for first, second in pairwise(stops_deg) if second != first]
    return Place(angle_deg=stops_deg[-1], direction=direction_of(ways_deg[-1]) if ways_deg else direction)


def _nominal_reply(step: Step, index: int) -> Reply:
    return Mounted(mount=step.mount) if isinstance(step, Mounting) else _nominal_point(step, index)


def _nominal_point(dwell: Dwell, index: int) -> Point:
    """The point of a dwell with a unit that gives 1 V/g along x and nothing else."""
    return Point(
        index=index,
        angle_deg=dwell.angle_deg,
        voltage_v=_nominal_voltage_v(dwell.mount, dwell.angle_deg),
        voltage_sd_v=0.0,
        samples=1,
        time_s=0.0,
        direction=0,
        temperature_degc=None,
        realisation=dwell.realisation,
        procedure=dwell.procedure,
        mount=dwell.mount,
        settled=True,
    )


@lru_cache(maxsize=4096)
def _nominal_voltage_v(mount: str, angle_deg: float) -> float:
    """Of that unit; a programme comes back to its poses, and is planned again and again."""
    return float(projections([mount], np.array([angle_deg]))[0, 0])
