"""The section on the closed loop: what the declared model left, to what it was traced, and what that changes."""

from collections.abc import Sequence
from typing import Any

from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.sentences import (
    comparisons,
    findings_of,
    headline,
    not_identifiable,
)
from tumble.calibrations.methods.dividing_head.report.abscissa import Abscissa
from tumble.calibrations.methods.dividing_head.report.chain import chain_part
from tumble.calibrations.methods.dividing_head.report.outlooks import outlook_figure
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.methods.dividing_head.report.traces import abscissae, trace_figure
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.messages import Message


def closed_loop(subject: Subject) -> dict[str, Any]:
    """The effects found, the models before and after, and the residual against what explains it."""
    loop, chain = subject.loop, {"chain": chain_part(subject.chain)}
    if loop is None:
        return {"headline": Message("What the residual comes from was not asked.")} | dict.fromkeys(_PARTS, ()) | chain
    found = bool(loop.effects or loop.unexplained)
    if not found:
        return {"headline": headline(loop)} | dict.fromkeys(_PARTS, ()) | chain
    parts = (findings_of(loop), _figures(loop), comparisons(loop), not_identifiable(loop), _experiments(loop))
    return {"headline": headline(loop)} | dict(zip(_PARTS, parts, strict=True)) | chain


_PARTS = ("findings", "figures", "comparisons", "not_identifiable", "experiments")
"""Of the section, below its headline; all empty where nothing was found."""


def _figures(loop: Loop) -> list[dict[str, Any]]:
    """Each figure with what it shows."""
    drawn = [_figure(loop, abscissa, seen) for abscissa, seen in abscissae(loop).items()]
    return [entry for entry in drawn if entry["figure"] is not None]


def _figure(loop: Loop, abscissa: Abscissa, seen: Sequence[str]) -> dict[str, Any]:
    models: dict[str, Calibration] = {
        Message("declared model"): loop.declared,
        Message("with what was found"): loop.augmented,
    }
    return {
        "figure": trace_figure(models, abscissa),
        "seen": series(seen),
        "as_angle": abscissa.as_angle,
        "levels": abscissa.levels,
    }


def _experiments(loop: Loop) -> list[dict[str, Any]]:
    """What to measure next, each with what it would show."""
    return [
        {
            "why": experiment.why,
            "command": experiment.command,
            "figure": outlook_figure(experiment.outlook, f"next-{number}") if experiment.outlook else None,
        }
        for number, experiment in enumerate(loop.next_experiment, start=1)
    ]
