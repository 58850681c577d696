"""Going on with a run that was cut off: the procedure is told again what it was told then."""

from collections.abc import Iterable
from dataclasses import dataclass

from tumble.messages import Message
from tumble.procedures.composition import advance
from tumble.procedures.errors import JournalError
from tumble.procedures.steps import Ask, Confirmed, Dwell, Point, Procedure, Reply, Step, pose


@dataclass(frozen=True, kw_only=True)
class Replayed:
    """Where a procedure stands after what was recorded."""

    points: tuple[Point, ...]
    pending: Step | None
    """The step that comes next; None where nothing is left to do."""
    dwells: tuple[Dwell, ...]
    """What the points answered, in their order."""
    asks: tuple[Ask, ...]
    """What was asked for the last point, the latest of each condition."""


def replay(procedure: Procedure, journal: Iterable[Reply], tolerance_deg: float) -> Replayed:
    """Send the recorded points into a fresh `procedure`, each compared with the step that it shall answer.

    Requests between the points answer themselves, as the points were taken under them; one after the last point is left
    pending, whether the journal has its reply or not, for nobody knows what was done to the unit since.

    Raises
    ------
    JournalError
        Where a point is not what the procedure asks for: another pose, procedure, realisation or number.
    """
    points = tuple(reply for reply in journal if isinstance(reply, Point))
    step = next(procedure, None)
    asks: dict[str, Ask] = {}
    dwells: list[Dwell] = []
    for number, point in enumerate(points):
        while isinstance(step, Ask):
            asks[step.condition] = step
            step = advance(procedure, Confirmed(condition=step.condition, value=step.value))
        dwells.append(_compared(number, point, step, tolerance_deg))
        step = advance(procedure, point)
    return Replayed(points=points, pending=step, dwells=tuple(dwells), asks=tuple(asks.values()))


def _compared(number: int, point: Point, dwell: Dwell | None, tolerance_deg: float) -> Dwell:
    """The dwell that a point answers. Raises `JournalError` where it answers another."""
    if dwell is None:
        raise _mismatch(number, point, Message("the programme is over"))
    expected = (number, dict(dwell.conditions), dwell.procedure, dwell.realisation)
    recorded = (point.index, dict(point.conditions), point.procedure, point.realisation)
    if recorded != expected or not _near(point, dwell, tolerance_deg):
        raise _mismatch(number, point, Message("the programme has {pose}", pose=_pose(number, dwell)))
    return dwell


def _near(point: Point, dwell: Dwell, tolerance_deg: float) -> bool:
    """Whether a point was taken where the dwell says, in every positioner."""
    targets_deg, positions_deg = dwell.targets_deg, point.positions_deg
    return targets_deg.keys() == positions_deg.keys() and all(
        abs(positions_deg[name] - target_deg) <= tolerance_deg for name, target_deg in targets_deg.items()
    )


def _mismatch(number: int, point: Point, programme_says: str) -> JournalError:
    return JournalError(
        Message.counted(
            "the recorded run does not belong to this programme: where it has {pose}, {programme_says} after "
            "{count} point; resume it with the programme that it was begun with",
            "the recorded run does not belong to this programme: where it has {pose}, {programme_says} after "
            "{count} points; resume it with the programme that it was begun with",
            pose=_pose(point.index, point),
            programme_says=programme_says,
            count=number,
        )
    )


def _pose(index: int, taken: Point | Dwell) -> str:
    where = pose(taken.conditions, taken.positions_deg if isinstance(taken, Point) else taken.targets_deg)
    return Message(
        "point {index} ({procedure}, realisation {realisation}, {where})",
        index=index,
        procedure=taken.procedure,
        realisation=taken.realisation,
        where=where,
    )
