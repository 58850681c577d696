"""A head measured against a reference as a table that may be traced."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.observations import Observations
from calibrations.reference.effects import HEAD_EFFECTS
from calibrations.reference.rows import as_dwells, as_they_are
from calibrations.reference.scene import HeadScene
from calibrations.reference.shapes import HEAD_STRUCTURES
from calibrations.tracing.declared import Linear
from calibrations.tracing.noise import Memory
from calibrations.tracing.table import Extensible, View, memory_of

MOST_EFFECTS: Final = 14
"""A circle has harmonics without end; with so many, what a head leaves is small."""
UNITS: Final = {"offset": "deg"}
"""The declared model: the reference stands by a constant angle from the head."""


@dataclass(frozen=True, kw_only=True)
class HeadTable(Extensible):
    """The table of a head that is measured against a reference. The output is reference minus head, in degrees."""

    scene: HeadScene
    """What is known so far of latency and backlash is in it."""

    @property
    def observations(self) -> Observations:
        """The dwells."""
        return self.scene.dwells.observations

    def view(self, rows: Observations, theta: FloatArray) -> HeadScene:  # noqa: ARG002
        """Rows as effects see them by what is known so far."""
        return replace(self.scene, dwells=as_they_are(rows))

    def functions(self, view: View) -> FloatArray:
        """One: a constant, shape (rows, 1)."""
        return np.ones((view.rows, 1))

    @property
    def wandering(self) -> "HeadTable":
        """The same for noise that remembers: neighbouring dwells err alike, which uncertainties must know."""
        return replace(self, memory=memory_of(self.effects, self.scene, self.weights))


def head_table(scene: HeadScene) -> HeadTable:
    """The table as effects are seen in a scene."""
    observations = scene.dwells.observations
    assert observations.reference_deg is not None, "as_dwells sees to that"
    rows = len(observations)
    return HeadTable(
        model=Linear(functions=np.ones((rows, 1))),
        output=np.asarray(observations.reference_deg - observations.angle_deg),
        unit="deg",
        weights=np.ones(rows),
        scene=scene,
        effects=HEAD_EFFECTS,
        structures=HEAD_STRUCTURES,
        memory=Memory(modes=np.empty((rows, 0))),
        most_effects=MOST_EFFECTS,
    )


def first_look(observations: Observations) -> HeadTable:
    """A table of which nothing is known yet. Raises `ValueError` without a reference."""
    return head_table(HeadScene(dwells=as_dwells(observations)))
