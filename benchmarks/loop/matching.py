"""Whether a table was traced to exactly what was put in."""

from collections.abc import Mapping, Sequence
from itertools import permutations
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.bank import Case
from benchmarks.bank.geometry import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.dividing_head.model import basis
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import mountings
from tumble.calibrations.tracing.findings import EffectFound, Unexplained

IntArray = NDArray[np.int64]


def is_exact(
    true_effects: Sequence[str],
    novel: Mapping[str, str],
    found: Sequence[EffectFound],
    unexplained: Unexplained | None,
) -> bool:
    """Judge a result.

    Parameters
    ----------
    true_effects
        Names of the effects of the catalogue that are there.
    novel
        Effects outside the catalogue that are there, with what each depends on.
    found
        Effects that were reported.
    unexplained
        Structure that was reported.
    """
    return _pairs_up(true_effects, found) and _rightly_unexplained(novel, unexplained)


def as_well(case: Case, unexplained: Unexplained | None) -> Mapping[str, str]:
    """What the effects outside the catalogue depend on; or what is said, where the rows do not part it from that.

    Not parted is a variable of which some function, beside the declared model, leaves less than 4.8 noise units of what
    they do.
    """
    truth = case.truth
    if unexplained is None or not truth.novel or unexplained.depends_on in truth.novel.values():
        return truth.novel
    left_v = min(_left_v(case, values, unexplained.channel) for values in _variables(case.observations, unexplained))
    return truth.novel if left_v > _PARTED * truth.spec.noise_v else dict.fromkeys(truth.novel, unexplained.depends_on)


_PARTED: Final = 4.8
_NOTHING: Final = 1e-9
_BINS: Final = 90
_FINER: Final = ("unwrapped_angle", "time_since_seating", "pose")


def _left_v(case: Case, values: FloatArray, channel: str) -> float:
    """What the declared model and any course along a variable leave of the effects outside the catalogue."""
    functions, novel_v = basis(case.observations), case.truth.novel_v
    gain = {"scale": functions[:, 1], "angle": functions[:, 2]}.get(channel, np.ones(len(values)))
    _, number = np.unique(np.round(values, 3), return_inverse=True)
    if number.max() >= _BINS:
        number = np.argsort(np.argsort(values, kind="stable"), kind="stable") * _BINS // len(values)
    course = (number[:, None] == np.arange(number.max() + 1)) * gain[:, None]
    left, sizes, _ = np.linalg.svd(np.column_stack([functions, course]), full_matrices=False)
    span = left[:, sizes > _NOTHING * sizes[0]]
    return float(np.linalg.norm(novel_v - span @ (span.T @ novel_v)))


def _variables(rows: Observations, unexplained: Unexplained) -> list[FloatArray]:
    """What may be meant by the variable that is said, each with a value for every row."""
    gravity = basis(rows)[:, [1, 3, 5]]
    said = unexplained.variable if unexplained.variable in _FINER else unexplained.depends_on
    told: list[NDArray[Any] | None] = {
        "angle": [rows.angle_deg % 360.0],
        "unwrapped_angle": [rows.angle_deg],
        "acceleration": [*gravity.T],
        "pose": [labels(*np.round(gravity / _CELL).T)],
        "time": [rows.time_s],
        "temperature": [rows.temperature_degc],
        "direction": [np.sign(np.diff(rows.angle_deg, prepend=rows.angle_deg[0]))],
        "realisation": [rows.realisations],
        "order": [_place(rows.realisations)],
        "time_since_seating": [_place(mountings(rows))],
    }[said]
    return [np.asarray(values, dtype=float) for values in told if values is not None]


_CELL: Final = 0.15


def _place(group: IntArray) -> IntArray:
    """Number of each row in its unbroken run of a group."""
    count = np.arange(len(group))
    return np.asarray(count - np.maximum.accumulate(np.where(np.diff(group, prepend=-1) != 0, count, 0)))


def _pairs_up(true_effects: Sequence[str], found: Sequence[EffectFound]) -> bool:
    """Whether effects reported and effects there can be paired one to one, under a name or as its rival."""
    if len(true_effects) != len(found):
        return False
    return any(
        all(name == effect.name or name in effect.also_possible for name, effect in zip(order, found, strict=True))
        for order in permutations(true_effects)
    )


def _rightly_unexplained(novel: Mapping[str, str], unexplained: Unexplained | None) -> bool:
    if unexplained is None or not novel:
        return unexplained is None and not novel
    return unexplained.depends_on in novel.values()
