"""What tracing found, as JSON (parts of tumble.loop/1)."""

import math
from collections.abc import Mapping
from typing import Any

from tumble.calibrations.tracing.effect import Quantity
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.findings import EffectFound, Unexplained

SCHEMA = "tumble.loop/1"


def experiment_json(experiment: Experiment) -> dict[str, Any]:
    """What to measure next."""
    return {"separates": list(experiment.separates), "why": experiment.why, "command": experiment.command}


def effect_json(effect: EffectFound) -> dict[str, Any]:
    """An effect that was found."""
    return {
        "name": effect.name,
        "also_possible": list(effect.also_possible),
        "belongs_to": effect.belongs_to,
        "coefficients": _quantities(effect.coefficients),
        "p_value": effect.p_value,
    }


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
    said: dict[str, Any] = {"depends_on": unexplained.depends_on, "description": unexplained.description}
    if unexplained.channel:
        said |= {"channel": unexplained.channel, "variable": unexplained.variable}
        said["also_possible"] = [
            {"channel": channel, "variable": variable} for channel, variable in unexplained.also_possible
        ]
    if unexplained.courses:
        said["courses"] = [course.as_json() for course in unexplained.courses]
    return said
