"""What changes between two visits to one setting: drift and temperature, seen free of every error of the circle."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.reference.effects import HEAD_EFFECTS, TIMED
from calibrations.reference.scene import HeadScene
from calibrations.reference.settings import Settings
from calibrations.reference.shapes import HEAD_STRUCTURES
from calibrations.tracing.declared import Linear
from calibrations.tracing.findings import EffectFound, Unexplained
from calibrations.tracing.linear_loop import Explained, explain_linear
from calibrations.tracing.noise import Memory
from calibrations.tracing.table import Table

_SPREAD = 0.25
"""Where so much of the scatter of the times lies within settings, they are what shows a drift."""
_SPARE_ROWS = 6
"""So many rows more than settings are needed."""


@dataclass(frozen=True, kw_only=True)
class WithinTable(Table):
    """Dwells beside the mean of their setting."""

    @property
    def fewest_rows(self) -> int:
        """A mean for each setting, and some rows to spare."""
        return self.model.parameters + _SPARE_ROWS


@dataclass(frozen=True, kw_only=True)
class Within:
    """What was found within the settings."""

    explained: Explained[WithinTable]

    @cached_property
    def shift_deg(self) -> FloatArray:
        """What it adds to the error of every dwell, shape (rows,)."""
        best = self.explained.best
        parts = [item.form.columns @ best.coefficients[columns]
                 for item, columns in zip(best.found, best.columns, strict=True)]  # fmt: skip
        return np.asarray(sum(parts, np.zeros(self.explained.table.rows)))

    @property
    def effects(self) -> tuple[EffectFound, ...]:
        """Those with a name."""
        return self.explained.effects(self.explained.best)

    @property
    def unexplained(self) -> tuple[Unexplained, ...]:
        """What has none."""
        return self.explained.unexplained


def within_settings(scene: HeadScene, settings: Settings, error_deg: FloatArray) -> Within | None:
    """Trace what changes between repeats; None where settings were not visited again after some time."""
    if not settings.repeated or scene.hours is None or not np.ptp(scene.hours):
        return None
    if np.sum(settings.within(scene.hours) ** 2) < _SPREAD * np.sum((scene.hours - scene.hours.mean()) ** 2):
        return None
    indicators = (settings.number[:, None] == np.arange(len(settings.visits))).astype(np.float64)
    rows = len(error_deg)
    table = WithinTable(
        model=Linear(functions=indicators),
        output=error_deg,
        unit="deg",
        weights=np.ones(rows),
        scene=scene,
        effects=tuple(effect for effect in HEAD_EFFECTS if effect.name in TIMED),
        structures=tuple(shape for shape in HEAD_STRUCTURES if shape.depends_on == "time"),
        memory=Memory(modes=np.empty((rows, 0))),
    )
    return Within(explained=explain_linear(table, {f"setting {n}": "deg" for n in range(len(settings.visits))}))
