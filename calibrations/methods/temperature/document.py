"""The loop closed on parameters against temperature as JSON (`tumble.loop/1`)."""

from typing import Any

from tumble.calibrations.methods.temperature.loop import ParameterLoop, Polynomial, TemperatureLoop
from tumble.calibrations.methods.temperature.shared import SharedCause
from tumble.calibrations.tracing.document import SCHEMA, effect_json
from tumble.calibrations.tracing.linear_loop import model_json, withheld_json


def document(loop: TemperatureLoop) -> dict[str, Any]:
    """The result; every parameter in the unit of its column."""
    return {
        "schema": SCHEMA,
        "method": "temperature",
        "kind": "parameters against temperature",
        "rows": {
            "read": len(loop.runs) + len(loop.runs.set_aside),
            "used": len(loop.runs),
            "set_aside": [{"row": entry.row, "reason": entry.reason} for entry in loop.runs.set_aside],
            "temperatures": loop.temperatures,
        },
        "temperature": loop.runs.temperature_name,
        "parameters": {parameter.name: _parameter_json(parameter) for parameter in loop.parameters},
        "shared": [_shared_json(cause) for cause in loop.shared],
        "cannot_be_known": list(loop.limits),
    }


def _parameter_json(parameter: ParameterLoop) -> dict[str, Any]:
    return {
        "unit": parameter.unit,
        "noise": _noise_json(parameter),
        "declared": model_json(parameter.declared, ""),
        "polynomials": [_polynomial_json(polynomial) for polynomial in parameter.polynomials],
        "effects": [effect_json(effect) for effect in parameter.effects],
        "withheld": withheld_json(parameter.explained),
        "augmented": model_json(parameter.augmented, ""),
    }


def _noise_json(parameter: ParameterLoop) -> dict[str, Any] | None:
    """Scatter of runs at one temperature; None where none was visited twice from one side."""
    pure = parameter.pure_error
    return (
        None if pure is None else {"pure_error": pure.standard_deviation, "degrees_of_freedom": pure.degrees_of_freedom}
    )


def _polynomial_json(polynomial: Polynomial) -> dict[str, Any]:
    return {
        "power": polynomial.power,
        "standard_deviation": polynomial.standard_deviation,
        "held_out_rms": polynomial.held_out_rms,
    }


def _shared_json(cause: SharedCause) -> dict[str, Any]:
    return {
        "name": "temperature_break",
        "at_degC": cause.at_degc,
        "between_degC": list(cause.between_degc),
        "parameters": list(cause.parameters),
        "p_value": cause.p_value,
        "one_temperature": cause.one,
    }
