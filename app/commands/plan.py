"""`tumble plan`: what a programme will do."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import click

from tumble.app.commands import options
from tumble.app.running import Outline
from tumble.app.stand import read_stand
from tumble.app.terminal import say
from tumble.procedures.plan import Plan, PlannedStep
from tumble.procedures.programme import load_programme
from tumble.procedures.steps import Dwell, Mounting

_FEW: Final = 4
"""So many settings are written out."""


@click.command("plan")
@click.argument("programme")
@options.stand
@click.option("--steps", "every_step", is_flag=True, help="Print every step, too.")
@options.json_out
def command(programme: str, stand_path: Path | None, every_step: bool, json_path: Path | None) -> None:
    """Print what a programme measures in each mounting and how long it takes, without moving anything."""
    planned = Outline(stand=read_stand(stand_path), programme=load_programme(programme)).plan()
    if str(json_path) != "-":
        say(_summary(planned), *(_steps(planned) if every_step else _mountings(planned)))
    options.write_json(_document(planned), json_path)


def _summary(planned: Plan) -> str:
    low, high = planned.angle_range_deg
    return (
        f"{planned.programme.name}: {planned.dwells} dwells between {low:g}° and {high:g}°, "
        f"{planned.mount_changes} mountings by hand, {_clock(planned.duration_s)} in all"
    )


def _mountings(planned: Plan) -> Iterator[str]:
    """One line for each time that the unit is seated."""
    began_s = 0.0
    for mount, dwells, duration_s in _seatings(planned.steps):
        yield f"  {_clock(began_s)}  {mount}: {'; '.join(_series(dwells))}"
        began_s += duration_s


def _seatings(steps: Sequence[PlannedStep]) -> Iterator[tuple[str, list[Dwell], float]]:
    """Mount, dwells and duration of every mounting."""
    dwells: list[Dwell] = []
    mount, duration_s = "", 0.0
    for planned in steps:
        if isinstance(planned.step, Mounting):
            if dwells:
                yield mount, dwells, duration_s
            mount, dwells, duration_s = planned.step.mount, [], 0.0
        else:
            mount = planned.step.mount
            dwells.append(planned.step)
        duration_s += planned.duration_s
    yield mount, dwells, duration_s


def _series(dwells: Sequence[Dwell]) -> Iterator[str]:
    """What is measured one after the other: `flip at -90°, 90°`, `sweep of 80 settings, 0° to 395°`."""
    for name, run in groupby(dwells, key=lambda dwell: f"{dwell.procedure} {dwell.realisation}"):
        angles_deg = [dwell.angle_deg for dwell in run]
        if len(angles_deg) <= _FEW:
            yield f"{name} at {', '.join(f'{angle_deg:g}°' for angle_deg in angles_deg)}"
        else:
            yield f"{name}, {len(angles_deg)} settings, {_range(angles_deg)}"


def _range(angles_deg: Sequence[float]) -> str:
    first_deg, last_deg = angles_deg[0], angles_deg[-1]
    if first_deg != last_deg:
        return f"{first_deg:g}° to {last_deg:g}°"
    return f"{first_deg:g}° to {max(angles_deg, key=lambda angle_deg: abs(angle_deg - first_deg)):g}° and back"


def _steps(planned: Plan) -> Iterator[str]:
    began_s = 0.0
    for number, step in enumerate(planned.steps, start=1):
        yield f"{number:5d}  {_clock(began_s)}  {_words(step)}"
        began_s += step.duration_s


def _words(planned: PlannedStep) -> str:
    step = planned.step
    if isinstance(step, Mounting):
        return f"seat the unit in {step.mount} ({planned.duration_s:.0f} s allowed)"
    return f"{step.procedure} {step.realisation}: {step.mount} at {step.angle_deg:g}° ({planned.duration_s:.1f} s)"


def _clock(duration_s: float) -> str:
    minutes, seconds = divmod(round(duration_s), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{seconds:02d}"


def _document(planned: Plan) -> dict[str, Any]:
    return {
        "schema": "tumble.plan/1",
        "programme": planned.programme.name,
        "duration_s": planned.duration_s,
        "dwells": planned.dwells,
        "mount_changes": planned.mount_changes,
        "angle_range_deg": list(planned.angle_range_deg),
        "steps": [_step_document(step) for step in planned.steps],
    }


def _step_document(planned: PlannedStep) -> dict[str, Any]:
    step = planned.step
    if isinstance(step, Mounting):
        return {"step": "mounting", "mount": step.mount, "duration_s": planned.duration_s}
    return {
        "step": "dwell",
        "mount": step.mount,
        "angle_deg": step.angle_deg,
        "procedure": step.procedure,
        "realisation": step.realisation,
        "duration_s": planned.duration_s,
    }
