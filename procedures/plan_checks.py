"""Whether a stand allows what a plan asks of it."""

from collections.abc import Callable, Collection, Iterator

from tumble.messages import Message
from tumble.procedures.composition import advance
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.plan import Plan, nominal_point
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Dwell


def check_limits(plan: Plan, positioner: str, limits_deg: tuple[float, float]) -> None:
    """Make sure that every dwell, and the way round to it, lies within the soft limits of a positioner.

    Raises
    ------
    ProgrammeError
        Names file, line, angle and limits.
    """
    lowest_deg, highest_deg = limits_deg
    for dwell, waypoints_deg in _ways(plan, positioner):
        beyond_deg = [angle for angle in waypoints_deg if not lowest_deg <= angle <= highest_deg]
        target_deg = dwell.targets_deg[positioner]
        if beyond_deg:
            beyond = Message("{angle_deg:g} deg", angle_deg=beyond_deg[-1])
            if beyond_deg[-1] != target_deg:
                beyond = Message(
                    "{angle_deg:g} deg on its way to {target_deg:g} deg",
                    angle_deg=beyond_deg[-1],
                    target_deg=target_deg,
                )
            raise ProgrammeError(
                Message(
                    "{origin}: the {procedure} goes to {beyond}, outside the {positioner}'s limits "
                    "of {lowest_deg:g} to {highest_deg:g} deg; change the angles, or the limits of the stand",
                    origin=_origin(plan.programme, dwell),
                    procedure=dwell.procedure,
                    beyond=beyond,
                    positioner=positioner,
                    lowest_deg=lowest_deg,
                    highest_deg=highest_deg,
                )
            )


def check_cable(plan: Plan, positioner: str, turns: float) -> None:
    """Make sure that a positioner, which begins unwound about its zero, never winds its cable further than it may.

    Raises
    ------
    ProgrammeError
        Names file, line, angle and turns.
    """
    for dwell, waypoints_deg in _ways(plan, positioner):
        if max(map(abs, waypoints_deg)) / 360.0 > turns:
            raise ProgrammeError(
                Message(
                    "{origin}: the {procedure} goes to {angle_deg:g} deg, and the cable allows {turns:g} turns "
                    "to either side of zero; change the angles, or cable_turns of the stand",
                    origin=_origin(plan.programme, dwell),
                    procedure=dwell.procedure,
                    angle_deg=dwell.targets_deg[positioner],
                    turns=turns,
                )
            )


def check_condition(plan: Plan, condition: str, allowed: Collection[str] | None) -> None:
    """Make sure that the seat of the unit allows every value of a condition; None allows all.

    Raises
    ------
    ProgrammeError
        Names file, line, value and those that there are.
    """
    if allowed is None:
        return
    for planned in plan.steps:
        step = planned.step
        if isinstance(step, Dwell) and step.conditions.get(condition, "") not in {*allowed, ""}:
            raise ProgrammeError(
                Message(
                    "{origin}: the {procedure} needs the {condition} {value}, and the seat allows {allowed} "
                    "only; change the {condition}, or {condition}s of the stand",
                    origin=_origin(plan.programme, step),
                    procedure=step.procedure,
                    condition=condition,
                    value=step.conditions[condition],
                    allowed=", ".join(allowed),
                )
            )


def check_temperatures(plan: Plan, condition: str, limits_degc: tuple[float, float]) -> None:
    """Make sure that a chamber may go to every temperature that a plan asks of it.

    Raises
    ------
    ProgrammeError
        Names file, line, temperature and limits.
    """
    low_degc, high_degc = limits_degc
    for planned in plan.steps:
        step = planned.step
        if not isinstance(step, Dwell) or condition not in step.conditions:
            continue
        value = step.conditions[condition]
        if not low_degc <= float(value) <= high_degc:
            raise ProgrammeError(
                Message(
                    "{origin}: the {procedure} needs {value} °C, and the chamber goes from {low:g} to {high:g} °C; "
                    "change the temperatures, or limits_degC of the stand",
                    origin=_origin(plan.programme, step),
                    procedure=step.procedure,
                    value=value,
                    low=low_degc,
                    high=high_degc,
                )
            )


def check_excitations(plan: Plan, condition: str, refusal: Callable[[str], str]) -> None:
    """Make sure that an exciter may do everything that a plan asks of it; `refusal` says why it may not, or nothing.

    Raises
    ------
    ProgrammeError
        Names file, line, excitation and limit.
    """
    for planned in plan.steps:
        step = planned.step
        if isinstance(step, Dwell) and condition in step.conditions and (why := refusal(step.conditions[condition])):
            raise ProgrammeError(
                Message(
                    "{origin}: the {procedure} needs {value}, and the exciter {why}; change the programme, or the "
                    "limits of the stand",
                    origin=_origin(plan.programme, step),
                    procedure=step.procedure,
                    value=step.conditions[condition],
                    why=why,
                )
            )


def _ways(plan: Plan, positioner: str) -> Iterator[tuple[Dwell, tuple[float, ...]]]:
    """Every dwell that moves a positioner, and where that stops for it."""
    for planned in plan.steps:
        if isinstance(planned.step, Dwell) and positioner in planned.waypoints_deg:
            yield planned.step, planned.waypoints_deg[positioner]


def _origin(programme: Programme, dwell: Dwell) -> str:
    """File and line of the first procedure that asks for `dwell`."""
    for number, part in enumerate(programme.parts):
        dwells = part.dwells(dwell.realisation)
        step = next(dwells, None)
        while step is not None and step != dwell:
            step = advance(dwells, nominal_point(programme, step, 0))
        if step == dwell:
            return programme.where(number)
    raise AssertionError(f"{dwell} is in no procedure of its own programme")
