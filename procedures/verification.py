"""After an interruption: whether the stand still measures what it measured before.

The last point is taken again. Two means of n samples differ by chance with the variance `s²/n + s²/n'`, s being the
largest of three standard deviations of a sample: pooled over the run, of the point, and of the new dwell. The head may
stand as far from where it stood as it may stand from where it is sent, which moves an output of amplitude A by at most
A times that angle in radians; A is estimated by half the range of the run. Allowed are five standard deviations of the
difference, and that.
"""

import math
from collections.abc import Sequence

from tumble.drivers.errors import DeviceError
from tumble.procedures.events import PointVerified
from tumble.procedures.reduction import Reduction
from tumble.procedures.settling import RESOLUTION_V
from tumble.procedures.steps import Point

_SIGMAS = 5.0


def allowed_v(points: Sequence[Point], now: Reduction, tolerance_deg: float) -> float:
    """By how much the last of `points` and a new measurement in its place may differ, in volts."""
    last = points[-1]
    measured = [point for point in points if math.isfinite(point.voltage_v)]
    pooled_v = math.sqrt(sum(point.voltage_sd_v**2 for point in measured) / len(measured))
    spread_v = max(pooled_v, last.voltage_sd_v, now.voltage_sd_v)
    voltages_v = [point.voltage_v for point in measured]
    amplitude_v = (max(voltages_v) - min(voltages_v)) / 2
    by_chance_v = _SIGMAS * spread_v * math.sqrt(1 / last.samples + 1 / now.samples)
    return max(by_chance_v + amplitude_v * math.radians(tolerance_deg), RESOLUTION_V)


def verified(
    points: Sequence[Point], now: Reduction, tolerance_deg: float, tolerance_v: float | None = None
) -> PointVerified:
    """What came of taking the last of `points` again; `tolerance_v` takes the place of what noise explains."""
    last = points[-1]
    return PointVerified(
        point=last.index,
        voltage_v=now.voltage_v,
        recorded_v=last.voltage_v,
        allowed_v=allowed_v(points, now, tolerance_deg) if tolerance_v is None else tolerance_v,
    )


def check_agreement(seen: PointVerified) -> None:
    """Make sure that the two voltages agree. Raises `DeviceError` where they do not, or where there is none now."""
    off_v = seen.voltage_v - seen.recorded_v
    if not abs(off_v) <= seen.allowed_v:
        raise DeviceError(
            "stand",
            f"point {seen.point} gives {seen.voltage_v:.6f} V now and gave {seen.recorded_v:.6f} V before the "
            f"interruption, where {seen.allowed_v:.2g} V is the most that noise explains",
            "look whether the unit, its mount or its wiring has changed; resume the run once it is as it was, or state "
            "what is allowed with --tolerance-v where only the room has changed",
        )
