"""Whether an exciter does what it was told, by what it says of itself."""

import math
from typing import Final

from tumble.drivers.excitation import Excitation, Random, Rest, Rotation, Sines, Tone
from tumble.drivers.protocols import ExciterStatus

TOLERANCE: Final = 2e-3
"""Of a level, relative; of a frequency a hundredth of it: instruments round what they are told."""
_NOTHING_G: Final = 1e-6


def is_at_rest(status: ExciterStatus) -> bool:
    """Whether it drives nothing."""
    return not status.on


def drives(status: ExciterStatus, told: Excitation) -> bool:
    """Whether it drives as it was told."""
    if not status.on:
        return False
    match told, status.excitation:
        case Sines(tones=wanted), Sines(tones=tones):
            return len(wanted) == len(tones) and all(map(_same_tone, wanted, tones))
        case Random(), Random():
            return _close(told.rms_g, status.excitation.rms_g)
        case Rotation(), Rotation(main_rad_s=main_rad_s, sub_rad_s=sub_rad_s):
            return _close(told.main_rad_s, main_rad_s) and _close(told.sub_rad_s, sub_rad_s)
        case Rest(), Rest():
            return True
    return False


def _same_tone(told: Tone, back: Tone) -> bool:
    apart_deg = ((told.phase_deg or 0.0) - (back.phase_deg or 0.0) + 180.0) % 360.0 - 180.0
    same_hz = math.isclose(told.frequency_hz, back.frequency_hz, rel_tol=TOLERANCE / 100.0)
    return told.shaker == back.shaker and same_hz and abs(apart_deg) < 0.1 and _close(told.level_g, back.level_g)


def _close(told: float, back: float) -> bool:
    return math.isclose(told, back, rel_tol=TOLERANCE, abs_tol=_NOTHING_G)
