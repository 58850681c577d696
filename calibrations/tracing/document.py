"""The closed loop as JSON (`tumble.loop/1`), and as a part of the result of a calibration."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from tumble.calibrations.effects.effect import Quantity
from tumble.calibrations.result import Calibration, rows_json
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.findings import EffectFound, Unexplained
from tumble.calibrations.tracing.loop import Loop
from tumble.calibrations.tracing.misreading import Misreading
from tumble.calibrations.tracing.reach import Reach
from tumble.calibrations.usable import usable
from tumble.calibrations.verdict import Verdict

SCHEMA = "tumble.loop/1"


def document(loop: Loop, verdict: Verdict | None = None) -> dict[str, Any]:
    """The result of closing the loop, with what was decided where that was asked."""
    noise = loop.augmented.noise
    return {
        "schema": SCHEMA,
        **_verdict_json(verdict),
        "rows": rows_json(loop.augmented.observations),
        "noise": {"pure_error_V": noise.pure_error_v, "degrees_of_freedom": noise.degrees_of_freedom},
        "declared": model_json(loop.declared),
        "effects": [effect_json(effect, loop.misread) for effect in loop.effects],
        "unexplained": unexplained_json(loop.unexplained),
        "withheld": [{"name": each.name, "reason": each.reason} for each in loop.withheld],
        "settings": settings_json(loop.reach),
        "still": [slope.as_json() for slope in loop.still.slopes] if loop.still else [],
        "augmented": model_json(loop.augmented),
        "next_experiment": [experiment_json(experiment) for experiment in loop.next_experiment],
        "warnings": list(loop.augmented.warnings),
    }


def settings_json(reach: Reach | None) -> dict[str, Any] | None:
    """How many settings there are, over what arc, and how many are left to show an effect."""
    if reach is None:
        return None
    return {"count": reach.settings, "arc_deg": reach.arc_deg, "spare": reach.spare, "few": reach.few}


def experiment_json(experiment: Experiment) -> dict[str, Any]:
    """What to measure next."""
    return {"separates": list(experiment.separates), "why": experiment.why, "command": experiment.command}


def result_document(calibration: Calibration, loop: Loop | None, verdict: Verdict | None = None) -> dict[str, Any]:
    """A calibration as `tumble.fit/1`, with the closed loop under `loop` where it was closed.

    `parameters`, and what is computed from them, are the values to use, of the model that `model` names; whether the
    declared model fits stays what it is. The declared model's own values are in the loop.
    """
    if loop is None:
        return calibration.as_json() | _verdict_json(verdict)
    use, declared = usable(calibration, loop), calibration.as_json()
    adequacy = {key: declared[key] for key in _ADEQUACY}
    return (
        {"schema": declared["schema"], **_verdict_json(verdict), "model": str(use.model)}
        | use.calibration.as_json()
        | adequacy
        | {"loop": document(loop)}
    )


_ADEQUACY = ("residual_rms_V", "held_out_rms_V", "lack_of_fit_p", "flip_closure")
"""How well the declared model fits."""


def _verdict_json(verdict: Verdict | None) -> dict[str, Any]:
    return {} if verdict is None else {"verdict": verdict.as_json()}


def model_json(calibration: Calibration) -> dict[str, Any]:
    """Parameters and adequacy of one of the two models."""
    return {
        "parameters": {name: parameter.as_json() for name, parameter in calibration.parameters.items()},
        "residual_rms_V": calibration.residual_rms_v,
        "held_out_rms_V": calibration.held_out_rms_v,
        "lack_of_fit_p": calibration.lack_of_fit_p,
    }


def effect_json(effect: EffectFound, misread: Sequence[Misreading] = ()) -> dict[str, Any]:
    """An effect that was found; `misread` are the rows of that name."""
    return {
        "name": effect.name,
        "also_possible": list(effect.also_possible),
        "belongs_to": effect.belongs_to,
        "coefficients": _misread_json(misread) if effect.name == "misreading" else _quantities(effect.coefficients),
        "p_value": effect.p_value,
    }


def _misread_json(misread: Sequence[Misreading]) -> dict[str, Any]:
    """Which rows were misread, and what has to be added to their angles to have the true ones."""
    return {"rows": [entry.row for entry in misread], "error_deg": [entry.error_deg for entry in misread]}


def _quantities(coefficients: Mapping[str, Quantity]) -> dict[str, Any]:
    return {key: _quantity_json(quantity) for key, quantity in coefficients.items()}


def _quantity_json(quantity: Quantity) -> dict[str, Any]:
    uncertainty = quantity.standard_uncertainty
    return {
        "value": quantity.value,
        "standard_uncertainty": uncertainty if uncertainty is not None and math.isfinite(uncertainty) else None,
        "unit": quantity.unit,
    }


def unexplained_json(unexplained: Unexplained | None) -> dict[str, Any] | None:
    """Structure without a name."""
    if unexplained is None:
        return None
    return {"depends_on": unexplained.depends_on, "description": unexplained.description}
