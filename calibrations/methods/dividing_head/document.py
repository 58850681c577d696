"""The closed loop as JSON (`tumble.loop/1`), and as a part of the result of a calibration."""

from collections.abc import Sequence
from typing import Any

from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.verdict import Verdict
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.misreading import MISREADING, Misreading
from tumble.calibrations.methods.dividing_head.loop.reach import Reach
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.usable import usable
from tumble.calibrations.tracing.document import SCHEMA, effect_json, experiment_json, unexplained_json
from tumble.calibrations.tracing.findings import EffectFound


def document(loop: Loop, verdict: Verdict | None = None) -> dict[str, Any]:
    """The result of closing the loop, with what was decided where that was asked."""
    noise = loop.augmented.noise
    return {
        "schema": SCHEMA,
        **_verdict_json(verdict),
        "rows": rows_json(loop.augmented.observations),
        "noise": {"pure_error_V": noise.pure_error_v, "degrees_of_freedom": noise.degrees_of_freedom},
        "declared": model_json(loop.declared),
        "effects": [_effect_json(effect, loop.misread) for effect in loop.effects],
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


def _effect_json(effect: EffectFound, misread: Sequence[Misreading]) -> dict[str, Any]:
    """An effect that was found; `misread` are the rows of that name."""
    coefficients = {"coefficients": _misread_json(misread)} if effect.name == MISREADING else {}
    return effect_json(effect) | coefficients


def _misread_json(misread: Sequence[Misreading]) -> dict[str, Any]:
    """Which rows were misread, and what has to be added to their angles to have the true ones."""
    return {"rows": [entry.row for entry in misread], "error_deg": [entry.error_deg for entry in misread]}
