"""`tumble plan`: what a programme will do."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from tumble.app import reports
from tumble.app.commands import options
from tumble.app.jobs import find_job, has_job
from tumble.app.running import Outline
from tumble.app.stand import WrittenStand, read_stand
from tumble.app.terminal import language, say
from tumble.calibrations.report.document import page_of_sections
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.layout import Layout
from tumble.procedures.plan import Plan, PlannedStep
from tumble.procedures.programmes import load_programme
from tumble.procedures.steps import Ask, Dwell, pose

if TYPE_CHECKING:
    from tumble.app.job_part import Promise

_FEW: Final = 4
"""So many settings are written out."""


@click.command("plan")
@click.argument("programme")
@options.stand
@click.option("--steps", "every_step", is_flag=True, help="Print every step, too.")
@options.json_out
@click.option("--pictures", "page", type=options.REPORT, help="Write a page (HTML) with a picture of every position.")
def command(
    programme: str, stand_path: Path | None, every_step: bool, json_path: Path | None, page: Path | None
) -> None:
    """Print what a programme measures in each mounting and how long it takes, without moving anything."""
    wanted = load_programme(programme)
    stand = read_stand(stand_path, wanted.method)
    planned = Outline(stand=stand, programme=wanted).plan()
    promise = _promise(planned, stand)
    if str(json_path) != "-":
        say(_summary(planned), *(_steps(planned) if every_step else _mountings(planned)))
        say(*(promise.sentences if promise else ()))
    options.write_json(_document(planned) | (promise.as_json() if promise else {}), json_path)
    if page is not None:
        _write_pictures(planned, page)


def _promise(planned: Plan, stand: WrittenStand) -> "Promise | None":
    """What the job of the method says of the result to be expected, if it says anything."""
    from tumble.app.job_part import Promising

    method = planned.programme.method
    part = find_job(method) if has_job(method) else None
    return part.promise(planned, stand) if isinstance(part, Promising) else None


def _write_pictures(planned: Plan, page: Path) -> None:
    """Write the page with pictures. Raises `InputError` where the method draws none."""
    from tumble.app.job_part import Pictured

    part = find_job(planned.programme.method)
    if not isinstance(part, Pictured):
        raise InputError(
            Message("the method {method} draws no positions; leave --pictures out", method=planned.programme.method)
        )
    dwells = [each.step for each in planned.steps if isinstance(each.step, Dwell)]
    sections = part.pictures([dwell.targets_deg for dwell in dwells])
    reports.write(
        page_of_sections(Message("Positions of a programme"), planned.programme.name, sections), page, language()
    )
    say(Message("pictures {page}", page=page), err=True)


def _summary(planned: Plan) -> str:
    dwells = Message.counted("{count} dwell", "{count} dwells", count=planned.dwells)
    requests = Message.counted("{count} mounting by hand", "{count} mountings by hand", count=planned.requests)
    if not any(isinstance(each.step, Dwell) and each.step.targets_deg for each in planned.steps):
        return Message(
            "{programme_name}: {dwells}, {requests}, {time} in all",
            programme_name=planned.programme.name,
            dwells=dwells,
            requests=requests,
            time=_clock(planned.duration_s),
        )
    low, high = planned.angle_range_deg
    return Message(
        "{programme_name}: {dwells} between {low:g}° and {high:g}°, {requests}, {time} in all",
        programme_name=planned.programme.name,
        dwells=dwells,
        low=low,
        high=high,
        requests=requests,
        time=_clock(planned.duration_s),
    )


def _mountings(planned: Plan) -> Iterator[str]:
    """One line for each time that the operator sets something."""
    began_s = 0.0
    for conditions, dwells, duration_s in _stretches(planned.steps):
        listed = Message.joined("; ", _series(dwells) if dwells[0].targets_deg else _set_otherwise(dwells))
        if conditions:
            listed = Message("{conditions}: {listed}", conditions=conditions, listed=listed)
        yield Message("  {time}  {listed}", time=_clock(began_s), listed=listed)
        began_s += duration_s


def _stretches(steps: Sequence[PlannedStep]) -> Iterator[tuple[str, list[Dwell], float]]:
    """Conditions that are set by hand, dwells and duration of every stretch between two requests."""
    by_hand = {each.step.condition for each in steps if isinstance(each.step, Ask) and each.by_hand}
    dwells: list[Dwell] = []
    conditions, duration_s = "", 0.0
    for planned in steps:
        if isinstance(planned.step, Ask):
            if dwells and planned.by_hand:
                yield conditions, dwells, duration_s
                dwells, duration_s = [], 0.0
        else:
            set_so = [value for name, value in planned.step.conditions.items() if name in by_hand]
            conditions = Message.joined(", ", set_so)
            dwells.append(planned.step)
        duration_s += planned.duration_s
    yield conditions, dwells, duration_s


def _series(dwells: Sequence[Dwell]) -> Iterator[str]:
    """What is measured one after the other: `flip at -90°, 90°`, `sweep of 80 settings, 0° to 395°`."""
    for name, run in groupby(dwells, key=lambda dwell: f"{dwell.procedure} {dwell.realisation}"):
        settings = [dwell.targets_deg for dwell in run]
        if len(settings) <= _FEW:
            yield Message(
                "{name} at {listed}",
                name=name,
                listed=Message.joined(", ", (pose({}, targets_deg, "°") for targets_deg in settings)),
            )
        else:
            ranges = (_range([targets_deg[positioner] for targets_deg in settings]) for positioner in settings[0])
            yield Message.joined(
                ", ", [name, Message.counted("{count} setting", "{count} settings", count=len(settings)), *ranges]
            )


def _set_otherwise(dwells: Sequence[Dwell]) -> Iterator[str]:
    """What nothing turns for: `17 dwells`, and every other condition of them once."""
    yield Message.counted("{count} dwell", "{count} dwells", count=len(dwells))
    changing = [
        name for name in dwells[0].conditions if len({dwell.conditions[name] for dwell in dwells}) > 1
    ]  # what a person sets stays as it is
    yield from dict.fromkeys(dwell.conditions[name] for name in changing for dwell in dwells)


def _range(angles_deg: Sequence[float]) -> str:
    first_deg, last_deg = angles_deg[0], angles_deg[-1]
    if first_deg != last_deg:
        return Message("{first_deg:g}° to {last_deg:g}°", first_deg=first_deg, last_deg=last_deg)
    return Message(
        "{first_deg:g}° to {turned_deg:g}° and back",
        first_deg=first_deg,
        turned_deg=max(angles_deg, key=lambda angle_deg: abs(angle_deg - first_deg)),
    )


def _steps(planned: Plan) -> Iterator[str]:
    began_s = 0.0
    for number, step in enumerate(planned.steps, start=1):
        yield Message("{number:5d}  {time}  {step}", number=number, time=_clock(began_s), step=_words(step))
        began_s += step.duration_s


def _words(planned: PlannedStep) -> str:
    step = planned.step
    if isinstance(step, Ask):
        return Message("{task} ({duration_s:.0f} s allowed)", task=step.task, duration_s=planned.duration_s)
    where = pose(step.conditions, step.targets_deg, "°")
    return Message(
        "{procedure} {realisation}: {where} ({duration_s:.1f} s)",
        procedure=step.procedure,
        realisation=step.realisation,
        where=where,
        duration_s=planned.duration_s,
    )


def _clock(duration_s: float) -> str:
    minutes, seconds = divmod(round(duration_s), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{seconds:02d}"


def _document(planned: Plan) -> dict[str, Any]:
    return {
        "schema": "tumble.plan/1",
        "programme": planned.programme.name,
        "duration_s": planned.duration_s,
        "dwells": planned.dwells,
        "mount_changes": planned.requests,
        "angle_range_deg": list(planned.angle_range_deg),
        "steps": [_step_document(planned.programme.layout, step) for step in planned.steps],
    }


def _step_document(layout: Layout, planned: PlannedStep) -> dict[str, Any]:
    step = planned.step
    if isinstance(step, Ask):
        kind = layout.conditions[step.condition].step
        return {"step": kind, step.condition: step.value, "duration_s": planned.duration_s}
    return {"step": "dwell", **layout.dwell_fields(step), "duration_s": planned.duration_s}
