"""How far an experiment would part explanations of a table that cannot be told apart in it.

The measure is that of T-optimality (Atkinson and Fedorov 1975): if one explanation is true, by how much -2 ln L of the
other is expected to lie above it, that is the squared length of what the other cannot follow, in standard deviations of
a dwell.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.observations import Observations
from calibrations.tracing.explanation import Explanation
from calibrations.tracing.ground import Ground, scene_of
from calibrations.tracing.probes import Probe, followed_by
from calibrations.tracing.rivals import Rival
from calibrations.tracing.trace import Trace


@dataclass(frozen=True, kw_only=True)
class Rows:
    """Rows that are there or would be."""

    observations: Observations
    weights: FloatArray

    def followed_by(self, probe: Probe) -> "Rows":
        """Add those of a probe."""
        joined = followed_by(self.observations, probe)
        added = np.ones(len(joined) - len(self.weights))
        return Rows(observations=joined, weights=np.concatenate([self.weights, added]))


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

    def __init__(self, base: Ground, trace: Trace, name: str, close: Sequence[Rival]) -> None:
        self.name, self.rivals = name, tuple(rival.name for rival in close)
        self.table = Rows(observations=base.joint.observations, weights=base.joint.weights)
        self._base = base
        self._found = Explanation(base, trace, name)
        self._rivals = [Explanation(base, rival.trace, rival.name) for rival in close]

    def belongs_to(self, name: str) -> str:
        """Owner of an effect."""
        return next((effect.belongs_to for effect in self._base.effects if effect.name == name), "unit")

    def separations(self, rows: Rows) -> FloatArray:
        """Expected difference in -2 ln L between the effect and each rival, shape (2, rivals).

        First if the effect is true, then if the rival is.
        """
        scene = scene_of(rows.observations, self._found.theta, self._base.scene.reference_temperature_degc)
        output = self._found.output_v(scene)[:, None] / self._found.dwell_v
        others = np.column_stack([rival.output_v(scene) for rival in self._rivals]) / self._found.dwell_v
        if_found = [rival.left(scene, rows.weights, output)[0] for rival in self._rivals]
        return np.array([if_found, self._found.left(scene, rows.weights, others)])
