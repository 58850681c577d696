"""Parameters against temperature, as the store takes them."""

from collections.abc import Mapping
from typing import Any

from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.methods.temperature.document import document
from tumble.calibrations.methods.temperature.loop import TemperatureLoop
from tumble.calibrations.records.entry import Entry

VERSION = 1


def entry(loop: TemperatureLoop) -> Entry:
    """A closed loop to be recorded; the terms of every parameter are called `parameter, term`."""
    result = document(loop)
    found = any(parameter.effects for parameter in loop.parameters)
    return Entry(
        method=result["method"],
        method_version=VERSION,
        result=result,
        parameters=_terms(result, "declared"),
        augmented=_terms(result, "augmented"),
        verdict=Verdict(judged=Model.AUGMENTED if found else Model.DECLARED, parameters=()),
    )


def _terms(result: Mapping[str, Any], model: str) -> dict[str, Mapping[str, Any]]:
    return {
        f"{name}, {term}": value
        for name, parameter in result["parameters"].items()
        for term, value in parameter[model]["parameters"].items()
    }
