"""The catalogue: effects of the unit and of the stand under vibration."""

from typing import Final

from tumble.calibrations.methods.vibration.effects.stand import STAND_EFFECTS
from tumble.calibrations.methods.vibration.effects.unit import UNIT_EFFECTS
from tumble.calibrations.methods.vibration.scene import VibrationScene
from tumble.calibrations.tracing.effect import Effect

VIBRATION_EFFECTS: Final[tuple[Effect[VibrationScene], ...]] = (*UNIT_EFFECTS, *STAND_EFFECTS)
OF_THE_LEVEL: Final = ("k_iiii", "clipping", "drive_pickup")
"""Effects that follow nothing but the level of the vibration, as long as its direction in the unit is one."""
