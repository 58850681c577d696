"""A result as the screen shows it, worked out where it keeps nobody waiting."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_correlation
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.window.work.activity import Concluded

if TYPE_CHECKING:
    from tumble.calibrations.methods.dividing_head.loop.sentences import Comparison
    from tumble.calibrations.tracing.sentences import Finding

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
class Presentation:
    """Everything on the screen Result but the words of the window itself."""

    concluded: Concluded
    verdict: Verdict
    model: Model
    """Whose values the table holds."""
    notices: tuple[str, ...]
    table: tuple[Any, ...]
    """`tumble.calibrations.methods.dividing_head.report.results.ResultRow`, one for each parameter."""
    names: tuple[str, ...]
    correlation: FloatArray
    correlation_texts: tuple[tuple[str, ...], ...]
    models: Mapping[str, Rows]
    """`declared` and, where something was found, `augmented`."""
    headline: str
    findings: "tuple[Finding, ...]"
    comparisons: "tuple[Comparison, ...]"
    untold: tuple[tuple[str, str], ...]
    leaning: str


def present(concluded: Concluded) -> Presentation:
    """Work out what there is to show."""
    from tumble.app.methods.dividing_head.analysed import DividingHeadTraced
    from tumble.calibrations.methods.dividing_head.loop.sentences import (
        comparisons,
        findings_of,
        headline,
        leaning,
        untold,
    )
    from tumble.calibrations.methods.dividing_head.report.results import notices, results
    from tumble.calibrations.methods.dividing_head.report.subject import Subject

    traced = concluded.traced
    assert isinstance(traced, DividingHeadTraced), "the only method that has a screen"
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
    return Presentation(
        concluded=concluded,
        verdict=traced.verdict,
        model=use.model,
        notices=tuple(notices(subject)),
        table=tuple(results(subject)["rows"]),
        names=tuple(use.calibration.parameters),
        correlation=use.calibration.correlation,
        correlation_texts=tuple(tuple(map(_coefficient, row)) for row in use.calibration.correlation),
        models=models,
        headline=headline(loop),
        findings=tuple(findings_of(loop)),
        comparisons=tuple(comparisons(loop)),
        untold=tuple(untold(loop)),
        leaning=leaning(loop),
    )


def rows_of(calibration: Calibration) -> Rows:
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
