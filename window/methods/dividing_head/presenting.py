"""A result of an accelerometer as the screen Result shows it, worked out where it keeps nobody waiting."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_correlation
from tumble.calibrations.core.view import Section
from tumble.window.generic.drawn import drawn_of
from tumble.window.work.activity import Concluded
from tumble.window.work.presentation import Correlations, LoopSummary, ParameterLine, Presentation

if TYPE_CHECKING:  # analysis and report take half a second: a window is up before that
    from tumble.calibrations.methods.dividing_head.loop.loop import Loop
    from tumble.calibrations.methods.dividing_head.report.results import ResultRow
    from tumble.calibrations.methods.dividing_head.result import Calibration

_MICRO = 1e6


@dataclass(frozen=True, kw_only=True)
class Rows:
    """The rows of one model, as plots need them."""

    mounts: list[str]
    abscissae: Mapping[str, FloatArray]
    """`angle`, `turn`, `time`, `temperature`, `realisation`, those that the data have; every one of shape (rows,)."""
    output_v: FloatArray
    residual_uv: FloatArray
    scatter_uv: float
    curves: Mapping[str, tuple[FloatArray, FloatArray]]
    """Head angle in degrees and model output in volts, by mount."""


@dataclass(frozen=True, kw_only=True)
class HeadPresentation(Presentation):
    """What the tabs of the method show beside."""

    models: Mapping[str, Rows]
    """`declared` and, where something was found, `augmented`."""
    budget: Sequence[Section]
    """What the uncertainties are made of, and their check by simulation."""


def models_of(presentation: Presentation) -> Mapping[str, Rows]:
    """The rows by model of a result of this method."""
    return _of_this_method(presentation).models


def budget_of(presentation: Presentation) -> Sequence[Section]:
    """The uncertainty budget of a result of this method."""
    return _of_this_method(presentation).budget


def _of_this_method(presentation: Presentation) -> HeadPresentation:
    assert isinstance(presentation, HeadPresentation), "a result is shown by the part of the method that presented it"
    return presentation


def present(concluded: Concluded) -> HeadPresentation:
    """Work out what there is to show."""
    from tumble.calibrations.methods.dividing_head.report.evidence import residual_sections
    from tumble.calibrations.methods.dividing_head.report.results import notices, results
    from tumble.calibrations.methods.dividing_head.report.subject import Subject
    from tumble.calibrations.methods.dividing_head.report.uncertainty import budget_sections

    traced = concluded.traced
    use, loop = traced.usable, traced.loop
    subject = Subject(
        calibration=traced.calibration,
        provenance=traced.provenance,
        limits=traced.limits,
        loop=loop,
        decided=traced.verdict,
    )
    models = {"declared": rows_of(traced.calibration)}
    if loop.effects or loop.unexplained:
        models["augmented"] = rows_of(loop.augmented)
    coefficients, summary = use.calibration.correlation, _summary(loop)
    return HeadPresentation(
        concluded=concluded,
        verdict=traced.verdict,
        notices=tuple(notices(subject)),
        table=tuple(_line(row) for row in results(subject)["rows"]),
        correlations=Correlations(
            names=tuple(use.calibration.parameters),
            coefficients=coefficients,
            texts=tuple(tuple(map(_coefficient, row)) for row in coefficients),
        ),
        picture=next(iter(summary.figures or drawn_of(islice(residual_sections(subject), 1))), None),
        loop=summary,
        models=models,
        budget=tuple(budget_sections(subject)),
    )


def _line(row: "ResultRow") -> ParameterLine:
    return ParameterLine(
        name=row.name,
        value=row.value,
        interval=row.interval,
        standard=row.standard,
        note=row.note,
        reason=row.reason,
        limits=row.limits,
        verdict=row.verdict,
        outcome=row.outcome,
    )


def _summary(loop: "Loop") -> LoopSummary:
    from tumble.calibrations.methods.dividing_head.loop import sentences
    from tumble.calibrations.methods.dividing_head.report.loop import before_and_after

    return LoopSummary(
        headline=sentences.headline(loop),
        findings=sentences.findings_of(loop),
        comparisons=[(line.name, line.declared, line.augmented, line.change) for line in sentences.comparisons(loop)],
        not_identifiable=sentences.not_identifiable(loop),
        dependence=sentences.dependence(loop),
        experiments=loop.next_experiment,
        figures=drawn_of(before_and_after(loop)) if loop.effects or loop.unexplained else (),
    )


def rows_of(calibration: "Calibration") -> Rows:
    """What plots need of a calibration."""
    from tumble.calibrations.methods.dividing_head.report.figures import model_curve

    observations, noise = calibration.observations, calibration.noise
    mounts = observations.mounts.tolist()
    curves = {mount: model_curve(calibration, mount) for mount in dict.fromkeys(mounts)}
    columns = {
        "angle": observations.angle_deg,
        "turn": np.mod(observations.angle_deg, 360.0),
        "time": None if observations.time_s is None else observations.time_s / 60.0,
        "temperature": observations.temperature_degc,
        "realisation": observations.realisation,
    }
    return Rows(
        mounts=mounts,
        abscissae={name: np.asarray(column, float) for name, column in columns.items() if column is not None},
        output_v=observations.output_v,
        residual_uv=np.asarray(calibration.residual_v * np.sqrt(calibration.weights) * _MICRO),
        scatter_uv=(noise.used_v if noise.pure_error_v is None else noise.pure_error_v) * _MICRO,
        curves={mount: curve for mount, curve in curves.items() if curve is not None},
    )


def _coefficient(value: float) -> str:
    return "" if not np.isfinite(value) else format_correlation(float(value))
