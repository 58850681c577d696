"""Levels that change at several places.

They are found one change after the other, the one that explains most beside the others first (orthogonal matching
pursuit, Pati, Rezaiifar and Krishnaprasad 1993), and each is moved to where it fits best beside the others.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import comb
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.gains import Gained, gain_of_process
from tumble.calibrations.tracing.shapes.along import Along, Shape, beside, named
from tumble.calibrations.tracing.shapes.places import FEWEST_PLACES, levels
from tumble.messages import Message

_MOST: Final = 12
"""Levels change so often at most."""
_DWELLS_EACH: Final = 12
"""So many dwells a level has at least, in the mean."""
_IN_VAIN: Final = 4
"""So many further changes that explain too little are the last: a jump to and fro is two."""
_ROUNDS: Final = 2
"""So often each change is moved."""
_ALIKE: Final = 1e-6
"""What is left of a column beside the others, in parts of the longest, is seen if it is more."""


def changes(along: Along) -> Iterator[Shape]:
    """Levels that change at the places, and as often, as explains most beyond what so many changes cost.

    Which of them is that of rest no row tells, where there are more than two.
    """
    places = along.coordinate.places
    if len(places) < FEWEST_PLACES:
        return
    most = min(max(min(_MOST, along.rows // (_DWELLS_EACH * along.coordinate.outputs)), 1), len(places))
    steps, chosen = _Steps.at(along, places), list[int]()
    told = list[tuple[float, list[int]]]()
    for count in range(1, most + 1):
        chosen = steps.settled([*chosen, steps.best_beside(chosen)])
        told.append((steps.gain(chosen)[0] - 2.0 * np.log(comb(len(places), count)), chosen))
        if count - len(max(told)[1]) == _IN_VAIN:
            break
    at, gained = _exact(along, places[sorted(max(told)[1])])
    rest = along.undetermined(np.ones(along.rows))
    yield Shape(
        name=named("changes", at.tolist()),
        described=Message.counted("in {count} step", "in {count} steps", count=len(at)),
        columns=partial(levels, along.coordinate.part, at),
        whole=beside(rest, partial(levels, along.coordinate.part, at)) if len(at) > 1 else None,
        gained=gained,
        tried=most * comb(len(places), len(at)),
    )


def _exact(along: Along, coarse: FloatArray) -> tuple[FloatArray, Gained]:
    """Each change where it fits best between two rows."""
    places = np.unique(np.concatenate([along.coordinate.nearby(float(place)) for place in coarse]))
    steps = _Steps.at(along, places)
    chosen = steps.settled(np.searchsorted(places, coarse).tolist())
    return places[sorted(chosen)], steps.gain(chosen)


@dataclass(frozen=True, kw_only=True)
class _Steps:
    """Steps at places, as products of their weighted columns."""

    whole: FloatArray
    """Squares, shape (places,)."""
    gram: FloatArray
    """Products with each other of what is seen of them, shape (places, places)."""
    with_left: FloatArray
    """Products with what is left of the output, shape (places,)."""
    squares: float
    rows: int

    @classmethod
    def at(cls, along: Along, places: FloatArray) -> "_Steps":
        columns = along.coordinate.stepped(places) * along.level[:, None]
        taken, whole = along.seen.taken.T @ columns, columns.T @ columns
        return cls(
            whole=np.diag(whole),
            gram=whole - taken.T @ taken,
            with_left=along.seen.left @ columns,
            squares=along.seen.squares,
            rows=along.rows,
        )

    def best_beside(self, chosen: Sequence[int]) -> int:
        """The step that explains most beside those that were chosen."""
        beside, among = self.gram[:, chosen], self.gram[np.ix_(chosen, chosen)]
        solved = np.linalg.lstsq(among, np.column_stack([beside.T, self.with_left[list(chosen)]]), rcond=_ALIKE)[0]
        left = np.diag(self.gram) - np.sum(beside * solved[:, :-1].T, axis=1)
        told = self.with_left - beside @ solved[:, -1]
        seen = left > _ALIKE * np.diag(self.gram).max()
        return int(np.argmax(np.where(seen, told**2 / np.where(seen, left, 1.0), -1.0)))

    def settled(self, chosen: Sequence[int]) -> list[int]:
        """Each of them in turn where it explains most beside the others."""
        moved = list(chosen)
        for _ in range(_ROUNDS):
            for number in range(len(moved)):
                moved[number] = self.best_beside(moved[:number] + moved[number + 1 :])
        return moved

    def gain(self, chosen: Sequence[int]) -> Gained:
        """What they explain together, with heights of one variance."""
        scale = float(np.sum(self.whole[list(chosen)])) / self.rows
        gram = self.gram[np.ix_(chosen, chosen)] / scale
        return gain_of_process(gram, self.with_left[list(chosen)] / np.sqrt(scale), self.squares, self.rows)
