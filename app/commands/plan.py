"""`tumble plan`: what a programme will do."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from tumble.app.commands import options
from tumble.app.running import Outline
from tumble.app.stand import read_stand
from tumble.app.terminal import say
from tumble.procedures.plan import Plan, PlannedStep
from tumble.procedures.programme import load_programme
from tumble.procedures.steps import Mounting


@click.command("plan")
@click.argument("programme")
@options.stand
@options.json_out
def command(programme: str, stand_path: Path | None, json_path: Path | None) -> None:
    """Print every step of a programme and its duration, without moving anything."""
    planned = Outline(stand=read_stand(stand_path), programme=load_programme(programme)).plan()
    if str(json_path) != "-":
        say(*_lines(planned))
    options.write_json(_document(planned), json_path)


def _lines(planned: Plan) -> Iterator[str]:
    began_s = 0.0
    for number, step in enumerate(planned.steps, start=1):
        yield f"{number:5d}  {_clock(began_s)}  {_words(step)}"
        began_s += step.duration_s
    low, high = planned.angle_range_deg
    yield (
        f"{planned.programme.name}: {planned.dwells} dwells between {low:g}° and {high:g}°, "
        f"{planned.mount_changes} mountings by hand, {_clock(planned.duration_s)} in all"
    )


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
