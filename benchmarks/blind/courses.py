"""Structure without a name as a result states it (`unexplained`, `courses`), in rows that the table did not hold."""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import numpy as np
from scipy.spatial import KDTree

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.unnamed.waves import lagged
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
_LATELY: Final = re.compile(r"acceleration ax of the last (\d+) s")
"""So is what acted in the time before, less what acts now."""
_ONCE: Final = frozenset({"time", "realisation"})
"""Variables that never come back: in another realisation, what followed them is expected at its mean."""


def stated_courses(unexplained: Json | None) -> list[Effect] | None:
    """Return what is stated of structure without a name as effects; None where it cannot be carried to other rows."""
    if unexplained is None:
        return []
    told = unexplained.get("courses", ())
    known = all(each["variable"] in _ONCE or _along(_variable(each)) is not None for each in told)
    return [_effect(each) for each in told] if told and known else None


def _variable(course: Json) -> str:
    return f"{course['variable']} {course['detail']}".strip()


def _along(variable: str) -> Callable[[World], FloatArray] | None:
    """Return how a variable is read in a world; None where it is not known."""
    if lately := _LATELY.fullmatch(variable):
        return lambda world: lagged(world.ax, world.run.time_s, float(lately[1])) - world.ax
    return _ALONG.get(variable)


def _effect(course: Json) -> Effect:
    def amount(world: World) -> FloatArray:
        acted = {"scale": world.ax, "cross": world.ax * world.ay}.get(course["channel"], 1.0)
        reversed_only = world.run.direction < 0 if course.get("channel_detail") == "reversal" else True
        return np.asarray(_followed(course, world) * acted * reversed_only)

    acts = Acts.ANGLE if course["channel"] == "angle" else Acts.OUTPUT
    return Effect(name=_variable(course), acts=acts, amount=amount, coefficients={})


def _followed(course: Json, world: World) -> FloatArray:
    at, value = np.array(course["at"]), np.array(course["value"])
    if course["variable"] in _ONCE:
        return np.full(len(world.run.time_s), value.mean())
    along = _along(_variable(course))
    assert along is not None, "courses along what is not known are left out"
    here = along(world)
    if at.ndim > 1:
        return np.asarray(value[KDTree(at).query(here)[1]])
    return np.asarray(np.interp(here, at, value, period=360.0 if course["variable"] == "angle" else None))


def together(named: Sequence[Effect] | None, courses: Sequence[Effect] | None) -> list[Effect] | None:
    """Return effects and courses; None where either is not known."""
    return None if named is None or courses is None else [*named, *courses]
