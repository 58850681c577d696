"""The loop closed on a head and its reference as JSON (`tumble.loop/1`)."""

from typing import Any

from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.methods.head_reference.adequacy import Agreement, AngleError, Reversal, Side
from tumble.calibrations.methods.head_reference.head_map import head_map
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.tracing.document import SCHEMA, effect_json, experiment_json, unexplained_json
from tumble.calibrations.tracing.linear_loop import model_json, withheld_json


def document(loop: ReferenceLoop) -> dict[str, Any]:
    """The result; every angle in degrees."""
    found = head_map(loop)
    unexplained = [unexplained_json(each) for each in loop.unexplained]
    return {
        "schema": SCHEMA,
        "method": "head_reference",
        "kind": "head against reference",
        "rows": {
            **rows_json(loop.observations),
            "read": loop.rows_read,
            "used": loop.rows_read - len(loop.observations.set_aside),
            "dwells": len(loop.observations),
            "settings": len(loop.explanation.settings.visits),
        },
        "noise": _noise_json(loop),
        "declared": _model_json(loop.declared, loop.agreements[0]),
        "effects": [effect_json(effect) for effect in loop.effects],
        "unexplained": unexplained[0] if unexplained else None,
        "further_unexplained": unexplained[1:],
        "augmented": _model_json(loop.augmented, loop.agreements[1]),
        "passes": _passes_json(loop),
        "withheld": withheld_json(loop.explained),
        "settings": {
            "count": loop.explanation.scene.distinct_angles,
            "arc_deg": loop.explanation.scene.arc_deg,
        },
        "by_setting": [_angle_json(each) for each in loop.by_setting],
        "reversal": _reversal_json(loop.reversal),
        "head_map": None if found is None else found.as_json(),
        "next_experiment": [experiment_json(experiment) for experiment in loop.next_experiment],
        "cannot_be_known": list(loop.limits),
        "warnings": list(loop.warnings),
    }


def _noise_json(loop: ReferenceLoop) -> dict[str, Any]:
    if loop.question:
        return {"dwell_deg": None, "degrees_of_freedom": None, "pure_error_deg": None, "basis": None}
    settings = loop.explanation.settings
    pure = settings.pure_error(loop.explanation.settled_deg) if settings.repeated else None
    return {
        "dwell_deg": loop.dwell_deg,
        "degrees_of_freedom": loop.degrees_of_freedom,
        "pure_error_deg": pure.standard_deviation if pure else None,
        "pure_error_degrees_of_freedom": pure.degrees_of_freedom if pure else 0,
        "basis": "repeats" if pure else "residual",
    }


def _model_json(model: ModelFit, agreement: Agreement | None) -> dict[str, Any]:
    """A model with the test of it against the repeats."""
    known = agreement is not None and agreement.f is not None
    tested = {
        "lack_of_fit_p": agreement.test.p_value if agreement is not None else None,
        "lack_of_fit": {
            "f": agreement.f,
            "degrees_of_freedom": [agreement.test.degrees_of_freedom, agreement.pure_degrees_of_freedom],
        }
        if agreement is not None and known
        else None,
    }
    return model_json(model, "deg") | tested


def _passes_json(loop: ReferenceLoop) -> dict[str, Any] | None:
    if loop.passes is None:
        return None
    return {
        "difference_before_deg": loop.passes.before_deg,
        "difference_after_deg": loop.passes.after_deg,
        "angles": loop.passes.angles,
    }


def _angle_json(each: AngleError) -> dict[str, Any]:
    return {
        "angle_deg": each.angle_deg,
        "forward": _side_json(each.forward),
        "backward": _side_json(each.backward),
        "unknown": _side_json(each.unknown),
        "reversal_deg": each.reversal_deg,
        "reversal_standard_uncertainty_deg": each.reversal_uncertainty_deg,
    }


def _side_json(side: Side | None) -> dict[str, Any] | None:
    if side is None:
        return None
    return {
        "error_deg": side.error_deg,
        "standard_uncertainty_deg": side.standard_uncertainty_deg,
        "visits": side.visits,
    }


def _reversal_json(tested: Reversal | None) -> dict[str, Any] | None:
    """Whether the reversal error is the same at every angle."""
    if tested is None:
        return None
    return {"f": tested.f, "degrees_of_freedom": list(tested.degrees_of_freedom), "p_value": tested.p_value}
