"""A head measured against a reference as a table that may be traced."""

from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import SAME_ANGLE_DEG, visits
from tumble.calibrations.methods.head_reference.effects import HEAD_EFFECTS, TIMED
from tumble.calibrations.methods.head_reference.observations import HeadObservations
from tumble.calibrations.methods.head_reference.rows import as_they_are
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.methods.head_reference.settings import Settings, angle_numbers
from tumble.calibrations.methods.head_reference.shapes import HEAD_STRUCTURES
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.effect import Variable
from tumble.calibrations.tracing.noise import Memory
from tumble.calibrations.tracing.table import Extensible, View, memory_of
from tumble.calibrations.tracing.within import too_few
from tumble.messages import Message

MOST_EFFECTS: Final = 14
"""A circle has harmonics without end; with so many, what a head leaves is small."""
UNITS: Final = {"offset": "deg"}
"""The declared model: the reference stands by a constant angle from the head."""


@dataclass(frozen=True, kw_only=True)
class HeadTable(Extensible):
    """The table of a head that is measured against a reference. The output is reference minus head, in degrees."""

    scene: HeadScene
    """What is known so far of latency and backlash is in it."""
    counted: Literal["rows", "settings"] = "rows"
    """What a row of the table is, in words: of repeats the mean of a setting."""
    streamed: bool = False
    """Whether the dwells are pieces of a stream."""
    visits: int = 0
    """How many dwells the rows are means of, where they are; else 0."""

    @property
    def observations(self) -> HeadObservations:
        """The dwells."""
        return self.scene.dwells.observations

    def view(self, rows: HeadObservations, theta: FloatArray) -> HeadScene:  # noqa: ARG002
        """Rows as effects see them by what is known so far."""
        return replace(self.scene, dwells=as_they_are(rows))

    def functions(self, view: View) -> FloatArray:
        """One: a constant, shape (rows, 1)."""
        return np.ones((view.rows, 1))

    def blocks(self, variable: Variable) -> NDArray[np.int64]:
        """Distinct angles of the circle, both sides of each together; stretches of time and of temperature."""
        if variable == "temperature" and self.scene.temperature_k is not None:
            return visits(self.scene.temperature_k, self.observations.realisations)
        if variable in ("time", "order", "temperature"):
            return np.argsort(np.argsort(self.scene.hours)) if self.scene.hours is not None else np.arange(self.rows)
        if variable == "realisation":
            return self.observations.realisations
        return angle_numbers((self.scene.angle_deg + SAME_ANGLE_DEG / 2) % 360.0)

    @property
    def not_traced(self) -> str:
        """Why nothing is looked for; empty where it is."""
        return too_few(self.rows, self.fewest_rows, self.counted_rows, self.visits)

    @property
    def counted_rows(self) -> Message:
        """Its rows in words, by what they are."""
        if self.counted == "settings":
            return self.counted_blocks("angle", self.rows)
        return Message.counted("{count} row", "{count} rows", count=self.rows)

    @property
    def wandering(self) -> "HeadTable":
        """The same for autocorrelated noise: neighbouring dwells err alike, which uncertainties must know.

        Means of settings come in no order of time, and remember nothing.
        """
        if self.visits:
            return self
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
        streamed=scene.dwells.streamed,
        effects=HEAD_EFFECTS,
        structures=HEAD_STRUCTURES,
        memory=Memory(modes=np.empty((rows, 0))),
        most_effects=MOST_EFFECTS,
    )


def table_of_settings(scene: HeadScene, settings: Settings, error_deg: FloatArray, *, timed: bool) -> HeadTable:
    """The table with one row for each setting, the mean of its repeats: settings carry no more numbers than that.

    Parameters
    ----------
    scene, settings
        The dwells, and which of them are repeats.
    error_deg
        Reference minus head, shape (rows,), free of what was found within the settings.
    timed
        Whether time and temperature may explain how settings differ; else that was seen within them.
    """
    observations = scene.dwells.observations
    moved = replace(observations, reference_deg=observations.angle_deg + error_deg, direction=scene.direction)
    means = moved.averaged(settings.number)
    table = replace(head_table(replace(scene, dwells=as_they_are(means))), counted="settings", visits=len(observations))
    return table if timed else without_time(table)


def without_time(table: HeadTable) -> HeadTable:
    """The same, looked at for nothing that depends on time or temperature."""
    return replace(
        table,
        effects=tuple(effect for effect in table.effects if effect.name not in TIMED),
        structures=tuple(shape for shape in table.structures if shape.depends_on != "time"),
    )
