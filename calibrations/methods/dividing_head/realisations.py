"""Which rows make a realisation: one pass through the settings, whatever the column says.

A realisation shows what changes from pass to pass (a turn-on, a seat) only if it is one: an unbroken run of rows, over
settings that come back in others. Pieces of one dwell that are numbered are repeats of their setting, no passes; with
other numbers, or none, they must say the same.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.repeats import labels, settings
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import distinct_settings
from tumble.messages import Message

_MOST = 50
_COME_BACK = 0.5
"""Part of the rows whose setting must be in more than one realisation."""
_AMISS = 0.02
"""Part of the rows that may be set aside where passes are clear."""
IntArray = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Passes:
    """A table with its realisations as they are."""

    observations: Observations
    remark: str = ""
    """What was made of the column, or of its lack; empty where it is what it says."""


def with_passes(observations: Observations) -> Passes:
    """Number realisations in the order in which they were taken; none where there are no passes."""
    stated = observations.realisation
    labelled = stated is not None and len(np.unique(stated)) > 1
    if stated is not None and labelled and _unbroken(stated) and _passes(observations, stated):
        return Passes(observations=replace(observations, realisation=_in_order(stated)))
    number = _clear_repeats(observations)
    remark = _remark(number, labelled, observations.source)
    return Passes(observations=replace(observations, realisation=number), remark=remark)


def _remark(number: IntArray | None, labelled: bool, source: str) -> str:
    """What was made of the column, or of its lack."""
    if number is None and labelled:
        return Message(
            "{source}: realisation numbers repeats, not passes through the settings; taken as repeats", source=source
        )
    if number is None:
        return ""
    if labelled:
        return Message(
            "{source}: realisation numbers no passes, yet every pose comes back {count} times; taken as {count} "
            "realisations, correct the column if that is not so",
            source=source,
            count=int(number.max()),
        )
    return Message(
        "{source}: there is no column realisation, yet every pose comes back {count} times; taken as {count} "
        "realisations, add the column if that is not so",
        source=source,
        count=int(number.max()),
    )


def _unbroken(number: IntArray) -> bool:
    return int(np.count_nonzero(np.diff(number))) + 1 == len(np.unique(number))


def _passes(observations: Observations, number: IntArray) -> bool:
    """Whether realisations go through settings, and come back to those of others."""
    each = np.unique(np.column_stack([distinct_settings(observations), number]), axis=0)
    visits = np.bincount(each[:, 0])[distinct_settings(observations)]
    return len(each) > len(np.unique(number)) and bool(np.mean(visits > 1) > _COME_BACK)


def _in_order(number: IntArray) -> IntArray:
    """From 1, as they come."""
    return np.cumsum(np.diff(number, prepend=number[:1] - 1) != 0)


def _clear_repeats(observations: Observations) -> IntArray | None:
    """Realisation of each row where the table falls into parts with the same poses; None where it does not."""
    columns: list[NDArray[np.generic]] = [observations.mounts, settings(observations.angle_deg)]
    if observations.procedure is not None:
        columns.append(observations.procedure)
    pose = labels(*columns, _move(observations))
    place = observations.row - 1
    length = int(observations.rows_read)
    for count in range(min(_MOST, length // 6), 1, -1):
        if length % count == 0 and _same_poses(pose, place // (length // count), count):
            return np.asarray(place // (length // count) + 1)
    return None


def _move(observations: Observations) -> IntArray:
    """Sign of the move to each row, the first coming from the last: a sweep back is no second pass."""
    return np.asarray(np.sign(np.diff(observations.angle_deg, prepend=observations.angle_deg[-1:])), dtype=np.int64)


def _same_poses(pose: IntArray, part: IntArray, count: int) -> bool:
    """Whether all parts have the same poses, a few rows set aside allowed for."""
    visits = np.zeros((count, int(pose.max()) + 1))
    np.add.at(visits, (part, pose), 1)
    return bool(np.abs(visits - np.median(visits, axis=0)).sum() <= _AMISS * len(pose))
