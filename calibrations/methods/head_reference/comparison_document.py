"""Two tables of one head compared, as JSON."""

from dataclasses import asdict
from typing import Any

from tumble.calibrations.methods.head_reference.changes import Comparison
from tumble.calibrations.methods.head_reference.map_difference import Difference
from tumble.calibrations.methods.head_reference.sentences import sentences


def comparison_json(comparison: Comparison, first: str, second: str) -> dict[str, Any]:
    """As plain data, under the keys that it adds to a document of two tables."""
    return {
        "changed": [asdict(change) | {"also_possible": list(change.also_possible)} for change in comparison.changes],
        "difference": None if comparison.difference is None else _difference_json(comparison, comparison.difference),
        "sentences": sentences(comparison, first, second),
    }


def _difference_json(comparison: Comparison, difference: Difference) -> dict[str, Any]:
    columns = difference.angle_deg, difference.direction, difference.difference_deg, difference.uncertainty_deg
    return {
        "head_changed": comparison.changed,
        "setup_offset_deg": {
            "value": difference.constant_deg,
            "standard_uncertainty": difference.constant_uncertainty_deg,
        },
        "f": difference.f,
        "degrees_of_freedom": [len(difference) - 1, difference.degrees_of_freedom],
        "p_value": difference.p_value,
        "basis": difference.basis,
        "points": [
            {"angle_deg": at, "direction": way, "difference_deg": value, "standard_uncertainty_deg": uncertainty}
            for at, way, value, uncertainty in zip(*(column.tolist() for column in columns), strict=True)
        ],
        "parts": [asdict(part) for part in comparison.parts],
        "unexplained": [
            {"depends_on": each.depends_on, "description": each.description, "shaped": each.shaped}
            for each in comparison.unexplained
        ],
        "slopes_deg_per_deg": [
            {"value": value, "standard_uncertainty": uncertainty} for value, uncertainty in comparison.slopes or ()
        ],
    }
