"""How far an experiment would part explanations of a table that are not distinguishable in it.

The measure is that of T-optimality (Atkinson and Fedorov 1975): if one explanation is true, the squared length T
of what the other cannot follow, in standard deviations of a dwell. As the noise is estimated with everything else,
-2 ln L of the other is then expected to lie above by n ln(1 + T/n) in n rows.

What is true is known only as it was fitted. What may be promised is the least that any effect would show that the
table does not refute, d standard uncertainties from the fit: T = |l + Ld|² with |d| up to `COVERAGE`. It counts on
from how far the explanations are apart by now, whatever they should have been.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.tracing.least import nearest_to_nothing
from tumble.calibrations.tracing.prediction import Prediction
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.table import Extensible
from tumble.calibrations.tracing.trace import Trace

APART: Final = 16.0
"""Explanations that differ by this in -2 ln L are distinguished: four standard deviations."""
COVERAGE: Final = 1.645
"""Standard uncertainties from the fit within which a promise is kept: the limit is passed in 5 of 100."""


@dataclass(frozen=True, kw_only=True)
class PlannedRows:
    """Rows that are there or would be; each gives one output of a table or several, one after the other."""

    rows: Rows
    weights: FloatArray
    """Of each output of each row, shape (outputs,)."""
    programmes: NDArray[np.str_]
    """The probe to which each output belongs; empty for those of the table."""
    further_weights: FloatArray = field(default_factory=lambda: np.ones(1))
    """Of the outputs of a row that is added."""

    @classmethod
    def of(cls, base: Extensible) -> "PlannedRows":
        """The rows of a table."""
        return cls(
            rows=base.observations,
            weights=base.weights,
            programmes=np.full(base.rows, ""),
            further_weights=base.further_weights,
        )

    def followed_by(self, probe: Probe) -> "PlannedRows":
        """Add those of a probe."""
        joined = probe.after(self.rows)
        added = np.tile(self.further_weights, len(joined) - len(self.rows))
        return replace(
            self,
            rows=joined,
            weights=np.concatenate([self.weights, added]),
            programmes=np.concatenate([self.programmes, np.full(len(added), probe.programme)]),
        )


@dataclass(frozen=True, kw_only=True)
class Difference:
    """How far one explanation of a table and its probes would be from another that is true."""

    true: str
    other: str
    left_v: FloatArray
    """What the other cannot follow, shape (rows,), in volts, weighted and whitened."""


@dataclass(frozen=True, kw_only=True)
class Outlook:
    """What the rows of a probe would show."""

    rows: Rows
    """The table and everything that is to be measured."""
    probed: NDArray[np.bool_]
    """Which of the rows are those of the probe."""
    dwell_v: float
    """Noise of a dwell, in volts."""
    differences: tuple[Difference, ...]
    """One for each rival that is distinguished."""


@dataclass(frozen=True, kw_only=True)
class Expected:
    """Differences in -2 ln L once further rows are there, if the effect is true and if each rival is: (2, rivals)."""

    separations: FloatArray
    """As the table was fitted."""
    promises: FloatArray
    """What they will hardly stay below, counted on from what they are now."""
    likely: FloatArray
    """What they will exceed about as often as not, counted on likewise."""


class Question:
    """Which of several explanations is true: an effect that was found, or one of its rivals.

    Parameters
    ----------
    base, trace
        The table, and what it was traced to.
    name
        The effect that was found.
    close
        Its rivals.
    """

    needed = APART

    def __init__(self, base: Extensible, trace: Trace, name: str, close: Sequence[Rival]) -> None:
        self.name, self.rivals = name, tuple(rival.name for rival in close)
        self.table = PlannedRows.of(base)
        self._base = base
        self.behind = np.array([rival.behind for rival in close])
        """How far each rival is behind by now, in -2 ln L, shape (rivals,)."""
        self._found = Prediction(base, trace, name)
        self._rivals = [Prediction(base, rival.trace, rival.name) for rival in close]

    def belongs_to(self, name: str) -> str:
        """Owner of an effect."""
        return next((effect.belongs_to for effect in self._base.effects if effect.name == name), "unit")

    @property
    def dwell_v(self) -> float:
        """Noise of a dwell, in volts."""
        return self._found.dwell_v

    def left(self, rows: PlannedRows) -> FloatArray:
        """What one explanation cannot follow of the other, in standard deviations of a dwell, shape (2, rows, rivals).

        First what each rival cannot follow if the effect is true, then what the effect cannot if the rival is; in rows
        that are weighted and whitened.
        """
        return np.array([np.column_stack([left[:, 0] for left in way]) for way in self._left(rows)])

    def separations(self, rows: PlannedRows) -> FloatArray:
        """Expected difference in -2 ln L between the effect and each rival, shape (2, rivals).

        First if the effect is true, then if the rival is.
        """
        return separation(self.left(rows))

    def expected(self, rows: PlannedRows) -> "Expected":
        """The same, with what may be promised of it."""
        lefts = self._left(rows)
        gained = np.array(
            [
                [_gained(after, now) for after, now in zip(*ways, strict=True)]
                for ways in zip(lefts, self._now, strict=True)
            ]
        )
        there = np.array([self.behind, -self.behind])
        return Expected(
            separations=np.array([[separation(left[:, :1])[0] for left in way] for way in lefts]),
            promises=there + gained[..., 0],
            likely=there + gained[..., 1],
        )

    def outlook(self, rows: PlannedRows, programme: str, apart: list[int], sure: bool) -> Outlook:
        """What a probe would show of each rival: where the two are closer if it is `sure`, else where they are not."""
        left = self.left(rows)
        each_way = separation(left)[:, apart]
        ways = each_way.argmin(axis=0) if sure else each_way.argmax(axis=0)
        pairs = [(self.name, self.rivals[rival]) for rival in apart]
        return Outlook(
            rows=rows.rows,
            probed=rows.programmes == programme,
            dwell_v=self.dwell_v,
            differences=tuple(
                Difference(true=pair[way], other=pair[1 - way], left_v=left[way, :, rival] * self.dwell_v)
                for pair, way, rival in zip(pairs, ways.tolist(), apart, strict=True)
            ),
        )

    @cached_property
    def _now(self) -> tuple[list[FloatArray], list[FloatArray]]:
        return self._left(self.table)

    def _left(self, rows: PlannedRows) -> tuple[list[FloatArray], list[FloatArray]]:
        """What is left of the effect by each rival, and by the effect of each rival, with their changes."""
        scene, weights = self._base.view(rows.rows, self._found.theta), rows.weights
        own = self._found.signal(scene)
        by_rivals = [rival.left(scene, weights, [own])[0] for rival in self._rivals]
        return by_rivals, self._found.left(scene, weights, [rival.signal(scene) for rival in self._rivals])


def _gained(after: FloatArray, now: FloatArray) -> tuple[float, float]:
    """By how much a difference grows at least, and likely, for signals of which so much, shape (rows, 1 + n), is left.

    A fit to noise alone has |l|² = |L|² on average: that much of it is taken for noise.
    """
    products, before = after.T @ after, now.T @ now
    further = products - before
    likely = max(float(2.0 * further[0, 0] - np.trace(further)), 0.0)
    rows, known = len(after), float(before[0, 0])
    least = nearest_to_nothing(further, COVERAGE)
    grown = [rows * float(np.log1p((known + more) / rows) - np.log1p(known / rows)) for more in (least, likely)]
    return grown[0], grown[1]


def separation(left: FloatArray) -> FloatArray:
    """Expected difference in -2 ln L where `left`, shape (…, rows, explanations), cannot be followed.

    In standard deviations of a dwell.
    """
    rows = left.shape[-2]
    return np.asarray(rows * np.log1p(np.sum(left**2, axis=-2) / rows))
