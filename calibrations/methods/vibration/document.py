"""The loop closed on vibrated dwells as JSON (`tumble.loop/1`, method `vibration`)."""

from typing import Any, Final

from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.methods.vibration.loop import VibrationDeclared, VibrationLoop
from tumble.calibrations.methods.vibration.shown import shown
from tumble.calibrations.tracing.document import SCHEMA, effect_json, experiment_json, unexplained_json

NAME: Final = "vibration"


def document(loop: VibrationLoop) -> dict[str, Any]:
    """The result; noise, coefficients before and after, effects, coefficients by band and lines."""
    rows, error = loop.observations, loop.pure_error
    return {
        "schema": SCHEMA,
        "method": NAME,
        "rows": rows_json(rows),
        "noise": {
            "pure_error_ug": error.standard_deviation if error.degrees_of_freedom else None,
            "degrees_of_freedom": error.degrees_of_freedom,
        },
        "warnings": list(rows.warnings),
        "declared": _model(loop.declared) | loop.declared_fit.budget.as_json(),
        "effects": [effect_json(effect) for effect in loop.effects],
        "withheld": [{"name": each.name, "reason": each.reason} for each in loop.withheld],
        "unexplained": unexplained_json(loop.unexplained),
        "augmented": _model(loop.augmented) | loop.augmented_budget.as_json(),
        **shown(loop).as_json(),
        "next_experiment": [experiment_json(each) for each in loop.experiments],
    }


def fit_document(declared: VibrationDeclared) -> dict[str, Any]:
    """The declared model alone as `tumble.fit/1`."""
    return {
        "schema": "tumble.fit/1",
        "method": NAME,
        "rows": rows_json(declared.observations),
        "warnings": list(declared.observations.warnings),
        **_model(declared.model),
        **declared.budget.as_json(),
    }


def _model(model: ModelFit) -> dict[str, Any]:
    return {
        "parameters": {name: parameter.as_json() for name, parameter in model.parameters.items()},
        "residual_rms_ug": model.residual_rms,
        "held_out_rms_ug": model.held_out_rms,
    }
