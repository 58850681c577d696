"""The loop closed on a head and its reference as JSON (`tumble.loop/1`)."""

from typing import Any

from calibrations.reference.head_map import head_map
from calibrations.reference.loop import ReferenceLoop
from calibrations.result import rows_json
from calibrations.tracing.document import SCHEMA, effect_json, experiment_json, unexplained_json
from calibrations.tracing.linear_loop import model_json


def document(loop: ReferenceLoop) -> dict[str, Any]:
    """The result; every angle in degrees."""
    found = head_map(loop)
    unexplained = [unexplained_json(each) for each in loop.unexplained]
    return {
        "schema": SCHEMA,
        "kind": "head against reference",
        "rows": {
            **rows_json(loop.observations),
            "read": loop.rows_read,
            "used": loop.rows_read - len(loop.observations.set_aside),
            "dwells": len(loop.observations),
        },
        "noise": {"dwell_deg": loop.dwell_deg, "degrees_of_freedom": loop.degrees_of_freedom},
        "declared": model_json(loop.declared, "deg"),
        "effects": [effect_json(effect) for effect in loop.effects],
        "unexplained": unexplained[0] if unexplained else None,
        "further_unexplained": unexplained[1:],
        "augmented": model_json(loop.augmented, "deg"),
        "passes": _passes_json(loop),
        "head_map": None if found is None else found.as_json(),
        "next_experiment": [experiment_json(experiment) for experiment in loop.next_experiment],
        "warnings": list(loop.warnings),
    }


def _passes_json(loop: ReferenceLoop) -> dict[str, Any] | None:
    if loop.passes is None:
        return None
    return {
        "difference_before_deg": loop.passes.before_deg,
        "difference_after_deg": loop.passes.after_deg,
        "angles": loop.passes.angles,
    }
