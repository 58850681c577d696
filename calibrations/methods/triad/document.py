"""The loop closed on a triad as JSON (`tumble.loop/1`, method `triad`), with the correction that a user loads."""

from typing import Any

from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.methods.triad.correction import correction
from tumble.calibrations.methods.triad.loop import TriadDeclared, TriadLoop
from tumble.calibrations.methods.triad.observations import CHANNELS
from tumble.calibrations.methods.triad.scalar import ScalarFit
from tumble.calibrations.tracing.document import SCHEMA, effect_json, unexplained_json


def document(loop: TriadLoop) -> dict[str, Any]:
    """The result; noise, parameters before and after, effects, the scalar fit and the correction."""
    rows = loop.observations
    return {
        "schema": SCHEMA,
        "method": "triad",
        "rows": rows_json(rows),
        "noise": {
            channel: {
                "pure_error_V": error.standard_deviation if error.degrees_of_freedom else None,
                "degrees_of_freedom": error.degrees_of_freedom,
            }
            for channel, error in zip(CHANNELS, loop.pure_errors, strict=True)
        },
        "warnings": [*loop.doubts, *rows.warnings],
        "declared": _model(loop.declared) | loop.declared_fit.budget.as_json(),
        "effects": [effect_json(effect) for effect in loop.effects],
        "withheld": [{"name": each.name, "reason": each.reason} for each in loop.withheld],
        "unexplained": unexplained_json(loop.unexplained),
        "augmented": _model(loop.augmented) | loop.augmented_budget.as_json(),
        "scalar": _scalar(loop.scalar),
        "mismatch_arcsec": _mismatch(loop.scalar),
        "correction": None if loop.doubts else correction(loop.best).as_json(),
        "next_experiment": [
            {"separates": list(each.separates), "why": each.why, "command": each.command} for each in loop.experiments
        ],
    }


def fit_document(declared: TriadDeclared) -> dict[str, Any]:
    """The declared model alone as `tumble.fit/1`."""
    return {
        "schema": "tumble.fit/1",
        "method": "triad",
        "rows": rows_json(declared.observations),
        "warnings": [*declared.doubts, *declared.observations.warnings],
        **_model(declared.model),
        **declared.budget.as_json(),
        "correction": None if declared.doubts else correction(declared.fit).as_json(),
    }


def _model(model: ModelFit) -> dict[str, Any]:
    return {
        "parameters": {name: parameter.as_json() for name, parameter in model.parameters.items()},
        "residual_rms_V": model.residual_rms,
        "held_out_rms_V": model.held_out_rms,
    }


def _scalar(fit: ScalarFit | None) -> dict[str, Any] | None:
    if fit is None:
        return None
    return {"parameters": {name: parameter.as_json() for name, parameter in fit.parameters.items()}}


def _mismatch(fit: ScalarFit | None) -> dict[str, Any] | None:
    if fit is None:
        return None
    mismatch = fit.mismatch
    return {
        "mean": mismatch.mean_arcsec,
        "sd": mismatch.standard_deviation_arcsec,
        "max": mismatch.largest_arcsec,
        "degrees_of_freedom": mismatch.degrees_of_freedom,
    }
