"""Judges the JSON of `tumble close-loop` (result.md) against the truth of a table."""

from collections.abc import Mapping, Sequence
from itertools import permutations
from typing import Any, Final

import numpy as np

from benchmarks.blind.courses import stated_courses, together
from benchmarks.blind.named import CATALOGUE, stated
from benchmarks.blind.right import COARSE
from benchmarks.blind.table import Table
from benchmarks.blind.world import Effect, Unit, respond_v

Json = Mapping[str, Any]

PARAMETERS: Final = ("u0", "kx", "ky", "kz", "kxy", "alpha0")
_WITHOUT_COURSE: Final = frozenset({"bias_random_walk", "realisation_bias", "seating", "misreading"})
"""Effects whose course on fresh realisations nobody can know: nothing is added for them."""


def score(table: Table, result: Json) -> dict[str, Any]:
    """Return every judgement of one table."""
    return {
        "exact": is_exact(table, result),
        "right_variable": is_right(table, result["unexplained"]),
        "said": said(result),
        "parameters": {name: judged_parameter(table, result["augmented"], name) for name in PARAMETERS},
        "held_out_stated": [result[part]["held_out_rms_V"] for part in ("declared", "augmented")],
        "fresh_rms_v": fresh_rms_v(table, result),
    }


def said(result: Json) -> str:
    """Return what the result names, in short."""
    effects = ["|".join((effect["name"], *effect["also_possible"])) for effect in result["effects"]]
    unexplained = result["unexplained"]
    strange = [f"unexplained:{unexplained.get('channel')}({_variable(unexplained)})"] if unexplained else []
    return " + ".join(effects + strange) or "nothing"


def is_exact(table: Table, result: Json) -> bool:
    """Whether the effects pair up one to one, and what has no name is found on a right variable, or is not there."""
    right = is_right(table, result["unexplained"]) if table.unnamed else result["unexplained"] is None
    return right and pairs_up(table.named, result["effects"])


def pairs_up(there: Sequence[str], found: Sequence[Json]) -> bool:
    """Whether each effect that is there is one found, under its name or in its `also_possible`."""
    return len(there) == len(found) and any(
        all(name in (effect["name"], *effect["also_possible"]) for name, effect in zip(order, found, strict=True))
        for order in permutations(there)
    )


def is_right(table: Table, unexplained: Json | None) -> bool:
    """Whether structure is reported on a variable that the design does not part from the true one."""
    if unexplained is None:
        return False
    coarse = {COARSE.get(name, name) for name in table.right}
    return unexplained["depends_on"] in coarse


def _variable(unexplained: Json) -> str:
    return str(unexplained.get("variable", unexplained["depends_on"]))


def judged_parameter(table: Table, part: Json, name: str) -> dict[str, Any]:
    """Return how a stated parameter stands to the truth: its state, and its error in half widths of `interval_95`."""
    told = part["parameters"].get(name)
    if told is None or told["value"] is None:
        return {"state": "withheld"}
    low, high = told["interval_95"]
    truth = getattr(table.unit, "alpha0_deg" if name == "alpha0" else name)
    half = (high - told["value"]) if truth > told["value"] else (told["value"] - low)
    conditional = "rests_on" in told or "given" in told
    return {
        "state": "conditional" if conditional else "unconditional",
        "inside": bool(low <= truth <= high),
        "half_widths": float(abs(truth - told["value"]) / half) if half > 0.0 else float("inf"),
    }


def fresh_rms_v(table: Table, result: Json) -> list[float | None]:
    """Return the error of prediction on fresh realisations before and after; None where none is offered.

    A prediction is the model of the contract with what the result states: effects, and the courses of structure that
    has no name.
    """
    effects = together(_stated(result["effects"]), stated_courses(result["unexplained"]))
    return [_error_v(table, result["declared"], []), _error_v(table, result["augmented"], effects)]


def _stated(effects: Sequence[Json]) -> list[Effect] | None:
    courses = [_course(effect) for effect in effects if effect["name"] not in _WITHOUT_COURSE]
    known = [course for course in courses if course is not None]
    return known if len(known) == len(courses) else None


def _course(effect: Json) -> Effect | None:
    values = {key: told["value"] if isinstance(told, Mapping) else told for key, told in effect["coefficients"].items()}
    complete = effect["name"] in CATALOGUE and None not in values.values()
    return stated(effect["name"], values) if complete else None


def _error_v(table: Table, part: Json, effects: list[Effect] | None) -> float | None:
    values = [part["parameters"].get(name, {}).get("value") for name in PARAMETERS]
    if effects is None or None in values:
        return None
    unit = Unit(**dict(zip((*PARAMETERS[:-1], "alpha0_deg"), values, strict=True)))
    fresh = table.run.fresh
    error_v = respond_v(table.run, unit, effects)[fresh] - table.noise_free_v[fresh]
    return float(np.sqrt(np.mean(error_v**2)))
