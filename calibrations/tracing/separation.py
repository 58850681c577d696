"""How far an experiment would part explanations of a table that are not distinguishable in it.

The measure is that of T-optimality (Atkinson and Fedorov 1975): if one explanation is true, the squared length T
of what the other cannot follow, in standard deviations of a dwell. As the noise is estimated with everything else,
-2 ln L of the other is then expected to lie above by n ln(1 + T/n) in n rows.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.tracing.prediction import Prediction
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.table import Extensible
from tumble.calibrations.tracing.trace import Trace


@dataclass(frozen=True, kw_only=True)
class PlannedRows:
    """Rows that are there or would be."""

    rows: Rows
    weights: FloatArray
    programmes: NDArray[np.str_]
    """The probe to which each row belongs; empty for the rows of the table."""

    def followed_by(self, probe: Probe) -> "PlannedRows":
        """Add those of a probe."""
        joined = probe.after(self.rows)
        added = np.ones(len(joined) - len(self.weights))
        return PlannedRows(
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

    def __init__(self, base: Extensible, trace: Trace, name: str, close: Sequence[Rival]) -> None:
        self.name, self.rivals = name, tuple(rival.name for rival in close)
        self.table = PlannedRows(rows=base.observations, weights=base.weights, programmes=np.full(base.rows, ""))
        self._base = base
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
        scene = self._base.view(rows.rows, self._found.theta)
        output = self._found.output_v(scene)[:, None] / self.dwell_v
        others = np.column_stack([rival.output_v(scene) for rival in self._rivals]) / self.dwell_v
        if_found = np.column_stack([rival.left(scene, rows.weights, output) for rival in self._rivals])
        return np.array([if_found, self._found.left(scene, rows.weights, others)])

    def separations(self, rows: PlannedRows) -> FloatArray:
        """Expected difference in -2 ln L between the effect and each rival, shape (2, rivals).

        First if the effect is true, then if the rival is.
        """
        return separation(self.left(rows))


def separation(left: FloatArray) -> FloatArray:
    """Expected difference in -2 ln L where `left`, shape (…, rows, explanations), cannot be followed.

    In standard deviations of a dwell.
    """
    rows = left.shape[-2]
    return np.asarray(rows * np.log1p(np.sum(left**2, axis=-2) / rows))
