"""Structure without a name as a result states it (`unexplained`, `courses`), in rows that the table did not hold."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import numpy as np
from scipy.spatial import KDTree

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.world import Acts, Effect, World

Json = Mapping[str, Any]

_ALONG: Final[Mapping[str, Callable[[World], FloatArray]]] = {
    "angle": lambda world: world.run.angle_deg % 360.0,
    "unwrapped_angle": lambda world: world.run.angle_deg,
    "acceleration ax": lambda world: world.ax,
    "acceleration ay": lambda world: world.ay,
    "acceleration az": lambda world: world.az,
    "pose": lambda world: world.gravity,
    "temperature": lambda world: world.run.temperature_degc,
    "time_since_seating": lambda world: world.run.since_seating_s / 3600.0,
    "direction sign": lambda world: world.run.direction.astype(float),
    "order in the realisation": lambda world: world.run.place.astype(float),
}
"""Variables that another realisation goes through again."""
_ONCE: Final = frozenset({"time", "realisation"})
"""Variables that never come back: in another realisation, what followed them is expected at its mean."""


def stated_courses(unexplained: Json | None) -> list[Effect] | None:
    """Return what is stated of structure without a name as effects; None where it cannot be carried to other rows."""
    if unexplained is None:
        return []
    told = unexplained.get("courses", ())
    known = all(each["variable"] in _ONCE or _variable(each) in _ALONG for each in told)
    return [_effect(each) for each in told] if told and known else None


def _variable(course: Json) -> str:
    return f"{course['variable']} {course['detail']}".strip()


def _effect(course: Json) -> Effect:
    def amount(world: World) -> FloatArray:
        return np.asarray(_followed(course, world) * (world.ax if course["channel"] == "scale" else 1.0))

    acts = Acts.ANGLE if course["channel"] == "angle" else Acts.OUTPUT
    return Effect(name=_variable(course), acts=acts, amount=amount, coefficients={})


def _followed(course: Json, world: World) -> FloatArray:
    at, value = np.array(course["at"]), np.array(course["value"])
    if course["variable"] in _ONCE:
        return np.full(len(world.run.time_s), value.mean())
    here = _ALONG[_variable(course)](world)
    if at.ndim > 1:
        return np.asarray(value[KDTree(at).query(here)[1]])
    return np.asarray(np.interp(here, at, value, period=360.0 if course["variable"] == "angle" else None))


def together(named: Sequence[Effect] | None, courses: Sequence[Effect] | None) -> list[Effect] | None:
    """Return effects and courses; None where either is not known."""
    return None if named is None or courses is None else [*named, *courses]
