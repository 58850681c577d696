"""Whether a table was traced to exactly what was put in."""

from collections.abc import Mapping, Sequence
from itertools import permutations
from typing import Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.bank import Case
from benchmarks.bank.geometry import FloatArray
from tumble.calibrations.methods.dividing_head.model import basis
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
    columns = np.column_stack([basis(case.observations), _any_course(case, unexplained)])
    left, values, _ = np.linalg.svd(columns, full_matrices=False)
    span = left[:, values > _NOTHING * values[0]]
    rest_v = truth.novel_v - span @ (span.T @ truth.novel_v)
    parted = float(np.linalg.norm(rest_v)) > _PARTED * truth.spec.noise_v
    return truth.novel if parted else dict.fromkeys(truth.novel, unexplained.depends_on)


_PARTED: Final = 4.8
_NOTHING: Final = 1e-9
_BINS: Final = 90


def _any_course(case: Case, unexplained: Unexplained) -> FloatArray:
    """One column for each value of the variable that is said, or for each of so many bins of it."""
    rows = case.observations
    moved = np.diff(rows.angle_deg, prepend=rows.angle_deg[0])
    told = {
        "angle": rows.angle_deg % 360.0,
        "unwrapped_angle": rows.angle_deg,
        "acceleration": rows.angle_deg % 360.0,
        "time": rows.time_s,
        "temperature": rows.temperature_degc,
        "direction": np.sign(moved),
        "realisation": rows.realisations,
        "order": _place(rows.realisations),
        "time_since_seating": _place(mountings(rows)),
    }[unexplained.variable if unexplained.variable in _FINER else unexplained.depends_on]
    assert told is not None, "nothing is said to depend on what was not measured"
    distinct, number = np.unique(np.round(np.asarray(told, dtype=float), 3), return_inverse=True)
    if len(distinct) > _BINS:
        number = np.argsort(np.argsort(told, kind="stable"), kind="stable") * _BINS // len(number)
    gravity = basis(rows)[:, 1:3]
    gain = {"scale": gravity[:, 0], "angle": gravity[:, 1]}.get(unexplained.channel, np.ones(len(number)))
    return np.asarray((number[:, None] == np.arange(number.max() + 1)) * gain[:, None])


_FINER: Final = ("unwrapped_angle", "time_since_seating")


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
