"""After an interruption: whether the stand still measures what it measured before.

The last point is taken again. Two means of n samples differ by chance with the variance `s²/n + s²/n'`, s being the
largest of three standard deviations of a sample: pooled over the run, of the point, and of the new dwell. A positioner
may stand as far from where it stood as it may stand from where it is sent, which moves an output of amplitude A by at
most A times that angle in radians; A is estimated by half the range of the run. Allowed are five standard deviations
of the difference, and that for every positioner. Each channel is held against its own.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from tumble.drivers.errors import DeviceError
from tumble.messages import Message
from tumble.procedures.events import PointVerified
from tumble.procedures.settling import RESOLUTION
from tumble.procedures.steps import Point, Reading
from tumble.procedures.units import unit_of

_SIGMAS = 5.0


def allowed(points: Sequence[Point], channel: str, now: Reading, tolerance_deg: float) -> float:
    """By how much the last of `points` and a new measurement in its place may differ, in the unit of the channel."""
    last = points[-1].readings[channel]
    measured = [reading for point in points if math.isfinite((reading := point.readings[channel]).mean)]
    pooled = math.sqrt(sum(reading.sd**2 for reading in measured) / len(measured))
    spread = max(pooled, last.sd, now.sd)
    means = [reading.mean for reading in measured]
    amplitude = (max(means) - min(means)) / 2
    by_chance = _SIGMAS * spread * math.sqrt(1 / last.samples + 1 / now.samples)
    by_angle = amplitude * math.radians(tolerance_deg) * len(points[-1].positions_deg)
    return max(by_chance + by_angle, RESOLUTION)


def verified(
    points: Sequence[Point], now: Mapping[str, Reading], tolerance_deg: float, tolerance_v: float | None = None
) -> Iterator[PointVerified]:
    """What came of taking the last of `points` again, channel by channel, but for those that it has no number of.

    `tolerance_v` takes the place of what noise explains.
    """
    last = points[-1]
    for channel, before in last.readings.items():
        if math.isfinite(before.mean):
            yield PointVerified(
                point=last.index,
                channel=channel,
                now=now[channel].mean,
                recorded=before.mean,
                allowed=allowed(points, channel, now[channel], tolerance_deg) if tolerance_v is None else tolerance_v,
            )


def check_agreement(seen: PointVerified) -> None:
    """Make sure that the two means agree. Raises `DeviceError` where they do not, or where there is none now."""
    unit = unit_of(seen.channel)
    if not abs(seen.now - seen.recorded) <= seen.allowed:
        raise DeviceError(
            Message("stand"),
            Message(
                "point {point} gives {now:.6f} {unit} now and gave {recorded:.6f} {unit} before the "
                "interruption, where {allowed:.2g} {unit} is the most that noise explains",
                point=seen.point,
                now=seen.now,
                unit=unit,
                recorded=seen.recorded,
                allowed=seen.allowed,
            ),
            Message(
                "look whether the unit, its mount or its wiring has changed; resume the run once it is as it "
                "was, or state what is allowed with --tolerance-v where only the room has changed"
            ),
        )
