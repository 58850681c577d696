"""Whether effects that are present at once can be told from fewer, or from each other, by anybody.

Two effects may add up to a third (of ax², ay² and az², two make the third and a bias), one may hide in the free phase
of another, and a bias that wanders is any slow course of the bias. Such sets have no one answer, and the bank leaves
them out.
"""

from collections.abc import Iterator, Mapping
from itertools import combinations

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.misreading import Misreading
from benchmarks.bank.scene import Effect, Sized, respond
from benchmarks.bank.unit_effects import Draw
from benchmarks.bank.visibility import Sight

_LEAST = 8.0
"""Noise units that an explanation with fewer effects must leave."""
_WALK = "bias_random_walk"
_SLOW = frozenset({"bias_drift", "warm_up", "realisation_bias", "bias_temperature"})
_SIZE = 0.01
"""Part of the physical maximum at which other effects are looked at."""


def told_apart(
    seen: Sight, sized: list[Sized], draws: Mapping[str, Draw], largest: Mapping[str, float], noise_v: float
) -> bool:
    """Whether each effect leaves something that the others, or one other in place of two, cannot be.

    Misreadings are told by themselves.

    `draws` and `largest` are those of every effect of the catalogue, by name.
    """
    sized = [(effect, amplitude) for effect, amplitude in sized if not isinstance(effect, Misreading)]
    names = {effect.name for effect, _ in sized}
    if _WALK in names and names & _SLOW:
        return False
    shifts = [_shift_v(seen, [one]) for one in sized]
    others = dict(_drawn_twice(seen, draws, largest))
    for place, shift in enumerate(shifts):
        beside = [other for number, other in enumerate(shifts) if number != place]
        kin = [other for name, drawn in others.items() if name in names - {sized[place][0].name} for other in drawn]
        if _left(seen, shift, [*beside, *kin]) < _LEAST * noise_v:
            return False
    for pair in combinations(range(len(sized)), 2):
        beside = [shift for number, shift in enumerate(shifts) if number not in pair]
        both = shifts[pair[0]] + shifts[pair[1]]
        if any(_left(seen, both, [*beside, *drawn]) < _LEAST * noise_v for drawn in others.values()):
            return False
    return True


def _drawn_twice(
    seen: Sight, draws: Mapping[str, Draw], largest: Mapping[str, float]
) -> Iterator[tuple[str, list[FloatArray]]]:
    """What every other effect does, in two of its shapes: together they hold every phase of a wave."""
    for name, draw in draws.items():
        if name != _WALK:
            drawn: list[Effect] = [draw(np.random.default_rng(number), seen.run) for number in (1, 2)]
            yield name, [_shift_v(seen, [(effect, _SIZE * largest[name])]) for effect in drawn]


def _shift_v(seen: Sight, sized: list[Sized]) -> FloatArray:
    return respond(seen.run, seen.unit, sized) - seen.plain_v


def _left(seen: Sight, shift_v: FloatArray, beside: list[FloatArray]) -> float:
    """Norm of what the declared model and the others leave of a shift."""
    columns = np.column_stack([seen.tangent, *(other for other in beside if other.any())])
    columns = columns / np.linalg.norm(columns, axis=0)
    left, values, _ = np.linalg.svd(columns, full_matrices=False)
    span = left[:, values > 1e-9 * values[0]]
    return float(np.linalg.norm(shift_v - span @ (span.T @ shift_v)))
