"""What a programme will do and how long it will take, worked out without moving anything."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from types import MappingProxyType

from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.approach import Place, direction_of
from tumble.procedures.composition import advance
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Ask, Confirmed, Dwell, Point, Reading, Step

REQUEST_S = 60.0
"""Time in which an operator does what is asked for, unless it is stated."""


@dataclass(frozen=True, kw_only=True)
class PlannedStep:
    """A step and the time it should take, in seconds."""

    step: Step
    duration_s: float
    waypoints_deg: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    """Angles at which a positioner stops, by its name, the dwell's own the last of them; none for a request."""
    by_hand: bool = False
    """Whether an operator does it."""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Every step of a programme, as it would go with a nominal unit."""

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
    def requests(self) -> int:
        """How often the operator must set something, the first time included."""
        return sum(planned.by_hand for planned in self.steps)

    @property
    def angle_range_deg(self) -> tuple[float, float]:
        """Lowest and highest target of any positioner; 0 and 0 where nothing moves."""
        dwells = [planned.step for planned in self.steps if isinstance(planned.step, Dwell)]
        targets_deg = [target_deg for dwell in dwells for target_deg in dwell.targets_deg.values()]
        return min(targets_deg, default=0.0), max(targets_deg, default=0.0)

    def steps_after(self, points: int) -> tuple[PlannedStep, ...]:
        """What is left to do once so many points are there."""
        ends = [number for number, planned in enumerate(self.steps, start=1) if isinstance(planned.step, Dwell)]
        return self.steps[ends[points - 1] :] if points else self.steps


def plan(
    programme: Programme,
    acquisition: Acquisition,
    *,
    speeds_deg_s: Mapping[str, float],
    request_s: float = REQUEST_S,
    setting_s: Mapping[str, float] = MappingProxyType({}),
    start_deg: float = 0.0,
) -> Plan:
    """Work out every step of `programme`.

    A dwell takes the longest of its positioners' moves from where they were, each at its own speed, the settling where
    the first two blocks agree, and the samples; a request takes `request_s`, or `setting_s` where the stand sets that
    condition by itself. Every positioner begins at `start_deg`.
    """
    procedure = programme.procedure()
    steps: list[PlannedStep] = []
    here = {name: Place(angle_deg=start_deg, direction=0) for name in speeds_deg_s}
    points = 0
    step: Step | None = next(procedure)
    while step is not None:
        if isinstance(step, Ask):
            by_hand = step.condition not in setting_s
            duration_s = request_s if by_hand else setting_s[step.condition]
            steps.append(PlannedStep(step=step, duration_s=duration_s, by_hand=by_hand))
            step = advance(procedure, Confirmed(condition=step.condition, value=step.value))
        else:
            planned = _planned(step, here, acquisition, speeds_deg_s)
            steps.append(planned)
            here |= {name: _arrived(here[name], way_deg) for name, way_deg in planned.waypoints_deg.items()}
            step = advance(procedure, nominal_point(programme, step, points))
            points += 1
    return Plan(programme=programme, steps=tuple(steps))


def _planned(
    dwell: Dwell, here: Mapping[str, Place], acquisition: Acquisition, speeds_deg_s: Mapping[str, float]
) -> PlannedStep:
    """A dwell whose positioners stand `here` before it. Raises `ProgrammeError` where the stand has no such one."""
    if missing := sorted(dwell.targets_deg.keys() - here.keys()):
        there = ", ".join(here) or Message("none")
        raise ProgrammeError(
            Message(
                "the {procedure} needs the positioner {missing}; the stand has {there}",
                procedure=dwell.procedure,
                missing=missing[0],
                there=there,
            )
        )
    approach, tolerance_deg = acquisition.approach, acquisition.position_tolerance_deg
    waypoints_deg = {
        name: approach.waypoints_deg(here[name], target_deg, tolerance_deg)
        for name, target_deg in dwell.targets_deg.items()
    }
    moves_s = [_length_deg(here[name], way_deg) / speeds_deg_s[name] for name, way_deg in waypoints_deg.items()]
    duration_s = max(moves_s, default=0.0) + acquisition.planned_settling_s + acquisition.dwell_s
    return PlannedStep(step=dwell, duration_s=duration_s, waypoints_deg=waypoints_deg)


def _length_deg(here: Place, way_deg: Sequence[float]) -> float:
    stops_deg = (here.angle_deg, *way_deg)
    return sum(abs(second - first) for first, second in pairwise(stops_deg))


def _arrived(here: Place, way_deg: Sequence[float]) -> Place:
    """Where a positioner stands after its last move that was one."""
    stops_deg = (here.angle_deg, *way_deg)
    moves_deg = [second - first for first, second in pairwise(stops_deg) if second != first]
    direction = direction_of(moves_deg[-1]) if moves_deg else here.direction
    return Place(angle_deg=stops_deg[-1], direction=direction)


def nominal_point(programme: Programme, dwell: Dwell, index: int) -> Point:
    """The point of a dwell with a nominal unit."""
    return Point(
        index=index,
        positions_deg=dwell.targets_deg,
        directions=dict.fromkeys(dwell.targets_deg, 0),
        readings={name: Reading(mean=mean, sd=0.0, samples=1) for name, mean in programme.nominal(dwell).items()},
        time_s=0.0,
        temperature_degc=None,
        procedure=dwell.procedure,
        realisation=dwell.realisation,
        conditions=dwell.conditions,
        settled=True,
    )
