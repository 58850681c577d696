"""How far the settings of a table reach: what so many of them, over such an arc, can show at all."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.tracing.blocks import Lack
from tumble.messages import Message

FEWEST_SPARE: Final = 6
"""With fewer settings beyond the declared model no effect of the setting is believed, unless it is gross.

An effect of one coefficient must then exceed what the settings leave by ten times and more (F of 1 and 5 at 3e-5: 150).
"""
ENOUGH: Final = "probe-repeat"
"""A programme that comes along, with 72 settings over a whole turn."""


@dataclass(frozen=True, kw_only=True)
class Reach:
    """The settings of a table, and what they differ by beyond everything that was found."""

    settings: int
    mounts: int
    arc_deg: float
    """The shortest arc of the head that holds all of them."""
    spare: int
    """How many there are beyond what is fitted: so many numbers are left to show an effect."""
    unit: str
    differ_by: float
    """Standard deviation of a setting about the model, in the unit of the output."""
    scatter: float
    """Standard deviation of a row about its setting."""
    alike: float
    """Chance of so large a difference by that scatter; 1 where there are no repeats."""

    @property
    def few(self) -> bool:
        """Whether they are too few to show what depends on them."""
        return self.spare < FEWEST_SPARE

    @property
    def sentence(self) -> str:
        """`9 settings over 180°`."""
        return Message.counted(
            "{count} setting over {arc_deg:.4g}°",
            "{count} settings over {arc_deg:.4g}°",
            count=self.settings,
            arc_deg=self.arc_deg,
        )

    @property
    def limits(self) -> str:
        """What they cannot show, in a sentence; empty where there are enough."""
        if not self.few:
            return ""
        left = Message.counted("{count} number", "{count} numbers", count=self.spare)
        return Message(
            "{settings} leave {left} beyond the model, however often they are repeated: too few to show an "
            "effect that depends on the setting; more settings over a longer arc would",
            settings=self.sentence,
            left=left if self.spare else Message("no number"),
        )


def reach(observations: Observations, lack: Lack, unit: str) -> Reach:
    """How far the rows in use reach; `lack` is what their settings leave."""
    repeats = len(observations) / max(lack.blocks, 1)
    return Reach(
        settings=lack.blocks,
        mounts=len(set(observations.mounts.tolist())),
        arc_deg=_arc_deg(observations.angle_deg),
        spare=lack.freedom,
        unit=unit,
        differ_by=float(np.sqrt(lack.between / repeats)),
        scatter=float(np.sqrt(lack.pure)),
        alike=lack.alike,
    )


def _arc_deg(angle_deg: FloatArray) -> float:
    """What is left of a turn without the widest gap."""
    turned_deg = np.sort(angle_deg % 360.0)
    gaps_deg = np.diff(turned_deg, append=turned_deg[:1] + 360.0)
    return 360.0 - float(gaps_deg.max())
