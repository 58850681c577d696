"""The closed loop as JSON (`tumble.loop/1`)."""

from typing import Any

from calibrations.effects.effect import Quantity
from calibrations.result import Calibration, rows_json
from calibrations.tracing.loop import EffectFound, Loop

SCHEMA = "tumble.loop/1"


def document(loop: Loop) -> dict[str, Any]:
    """The result of closing the loop."""
    noise = loop.augmented.noise
    return {
        "schema": SCHEMA,
        "rows": rows_json(loop.augmented.observations),
        "noise": {"pure_error_V": noise.pure_error_v, "degrees_of_freedom": noise.degrees_of_freedom},
        "declared": model_json(loop.declared),
        "effects": [_effect_json(effect) for effect in loop.effects],
        "unexplained": (
            {"depends_on": loop.unexplained.depends_on, "description": loop.unexplained.description}
            if loop.unexplained
            else None
        ),
        "augmented": model_json(loop.augmented),
        "next_experiment": [],
    }


def model_json(calibration: Calibration) -> dict[str, Any]:
    """Parameters and adequacy of one of the two models."""
    return {
        "parameters": {name: parameter.as_json() for name, parameter in calibration.parameters.items()},
        "residual_rms_V": calibration.residual_rms_v,
        "held_out_rms_V": calibration.held_out_rms_v,
        "lack_of_fit_p": calibration.lack_of_fit_p,
    }


def _effect_json(effect: EffectFound) -> dict[str, Any]:
    return {
        "name": effect.name,
        "also_possible": list(effect.also_possible),
        "belongs_to": effect.belongs_to,
        "coefficients": {key: _quantity_json(quantity) for key, quantity in effect.coefficients.items()},
        "p_value": effect.p_value,
    }


def _quantity_json(quantity: Quantity) -> dict[str, Any]:
    return {
        "value": quantity.value,
        "standard_uncertainty": quantity.standard_uncertainty,
        "unit": quantity.unit,
    }
