"""The catalogue of a gyrocompass: effects of drift, of the torquer, of the platform, of the turntable."""

from typing import Final

from tumble.calibrations.methods.gyrocompass.effects.drift import DRIFT_EFFECTS
from tumble.calibrations.methods.gyrocompass.effects.platform import PLATFORM_EFFECTS
from tumble.calibrations.methods.gyrocompass.effects.torquer import TORQUER_EFFECTS
from tumble.calibrations.methods.gyrocompass.effects.turntable import TURNTABLE_EFFECTS
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.tracing.effect import Effect

GYROCOMPASS_EFFECTS: Final[tuple[Effect[GyrocompassScene], ...]] = (
    *DRIFT_EFFECTS,
    *TORQUER_EFFECTS,
    *PLATFORM_EFFECTS,
    *TURNTABLE_EFFECTS,
)
