"""The result of closing the loop on a gyrocompass, as JSON (tumble.loop/1)."""

from typing import Any

from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.methods.gyrocompass.azimuth_channel import NOT_MEASURED
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassDeclared, GyrocompassLoop
from tumble.calibrations.methods.gyrocompass.misreading import MISREADING, misread_json
from tumble.calibrations.tracing.document import SCHEMA, effect_json, experiment_json, unexplained_json
from tumble.calibrations.tracing.findings import EffectFound


def document(loop: GyrocompassLoop) -> dict[str, Any]:
    """The result: noise, heading and drift before and after, effects, what to measure next."""
    rows, error = loop.observations, loop.pure_error
    return {
        "schema": SCHEMA,
        "method": "gyrocompass",
        "rows": rows_json(rows),
        "noise": {
            "pure_error_deg_h": error.standard_deviation if error.degrees_of_freedom else None,
            "degrees_of_freedom": error.degrees_of_freedom,
        },
        "warnings": [*loop.doubts, *rows.warnings],
        "declared": _model(loop.declared) | loop.declared_fit.budget.as_json(),
        "effects": [_effect(each, loop) for each in loop.effects],
        "withheld": [{"name": each.name, "reason": each.reason} for each in loop.withheld],
        "unexplained": unexplained_json(loop.unexplained),
        "augmented": _model(loop.augmented) | loop.augmented_budget.as_json(),
        **_beside(loop),
        "next_experiment": [experiment_json(each) for each in loop.experiments],
    }


def fit_document(declared: GyrocompassDeclared) -> dict[str, Any]:
    """The declared model alone as `tumble.fit/1`."""
    return {
        "schema": "tumble.fit/1",
        "method": "gyrocompass",
        "rows": rows_json(declared.observations),
        "warnings": [*declared.doubts, *declared.observations.warnings],
        **_model(declared.model),
        **declared.budget.as_json(),
    }


def _beside(loop: GyrocompassLoop) -> dict[str, Any]:
    """What else the rows say: other headings, checks of the heading, the azimuth channel, values in declared noise."""
    closure, baseline, drift, mark = loop.closure, loop.baseline, loop.azimuth_drift, loop.mark
    noise = loop.in_declared_noise
    u_deg = loop.augmented.parameters["alpha0"].standard_uncertainty
    return {
        "headings_deg": list(loop.declared_fit.headings_deg),
        "closure": closure.as_json() if closure else None,
        "baseline": baseline.as_json() if baseline else None,
        "azimuth_drift": drift.as_json(u_deg or 0.0) if drift else {"value": None, "reason": NOT_MEASURED},
        "azimuth_mark": mark.as_json() if mark else None,
        "declared_noise": noise.as_json() if noise else None,
    }


def _effect(effect: EffectFound, loop: GyrocompassLoop) -> dict[str, Any]:
    misread = {"coefficients": misread_json(loop.misread)} if effect.name == MISREADING else {}
    return effect_json(effect) | misread


def _model(model: ModelFit) -> dict[str, Any]:
    return {
        "parameters": {name: parameter.as_json() for name, parameter in model.parameters.items()},
        "residual_rms_deg_h": model.residual_rms,
        "held_out_rms_deg_h": model.held_out_rms,
    }
