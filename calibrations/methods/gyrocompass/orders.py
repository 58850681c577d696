"""Which positions, in which order, for how long: what each choice makes of the heading in a drift that wanders."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.methods.gyrocompass.expected import DriftNoise, ExpectedHeading, expected_heading
from tumble.messages import Message

ORDERS: Final[Mapping[str, tuple[float, ...]]] = {
    "0/90/180": (0.0, 90.0, 180.0),
    "0/120/240": (0.0, 120.0, 240.0),
    "0/90/180/270": (0.0, 90.0, 180.0, 270.0),
    "0/180/90/270": (0.0, 180.0, 90.0, 270.0),
    "0/90/180/90/0": (0.0, 90.0, 180.0, 90.0, 0.0),
}
"""Positions of one pass in their order, in degrees, by the name that they have."""
DWELLS_S: Final = (1.0, 10.0, 30.0, 60.0, 120.0)
"""Averaging times that are tried."""
_PASSES: Final = (1, 2, 3, 5, 10, 20)


@dataclass(frozen=True, kw_only=True)
class Way:
    """Positions in an order, repeated, with an averaging time at each."""

    order: str
    passes: int
    dwell_s: float
    minutes: float
    """From the first dwell to the end of the last."""
    heading: ExpectedHeading

    @property
    def sentence(self) -> Message:
        """The way in words."""
        return Message(
            "{passes} × {order}, {dwell:g} s at each position: {minutes:.1f} min, {rms:.3f}° r.m.s.",
            passes=self.passes,
            order=self.order,
            dwell=self.dwell_s,
            minutes=self.minutes,
            rms=self.heading.rms_deg,
        )


def way(
    order: str,
    dwell_s: float,
    turn_s: float,
    latitude_deg: float,
    noise: DriftNoise,
    *,
    passes: int = 1,
    known_latitude: bool = True,
) -> Way | None:
    """What an order of `ORDERS` makes of the heading; None where its positions do not tell it."""
    azimuths_deg = ORDERS[order] * passes
    starts_s = np.arange(len(azimuths_deg)) * (dwell_s + turn_s)
    heading = expected_heading(
        azimuths_deg, starts_s.tolist(), dwell_s, latitude_deg, noise, known_latitude=known_latitude
    )
    if heading is None:
        return None
    minutes = float(starts_s[-1] + dwell_s) / 60.0
    return Way(order=order, passes=passes, dwell_s=dwell_s, minutes=minutes, heading=heading)


def ways_to(
    target_deg: float, turn_s: float, latitude_deg: float, noise: DriftNoise, orders: Sequence[str] = tuple(ORDERS)
) -> tuple[Way, ...]:
    """The quickest way of each order whose heading is as certain as asked for (r.m.s. over headings), quickest first.

    Orders that do not come so far with the averaging times and repeats that are tried are left out.
    """
    found = [_quickest(_enough(order, target_deg, turn_s, latitude_deg, noise)) for order in orders]
    return tuple(sorted((each for each in found if each is not None), key=lambda each: each.minutes))


def _quickest(ways: Iterator[Way]) -> Way | None:
    return min(ways, key=lambda each: each.minutes, default=None)


def _enough(order: str, target_deg: float, turn_s: float, latitude_deg: float, noise: DriftNoise) -> Iterator[Way]:
    """For each averaging time the fewest repeats that do."""
    for dwell_s in DWELLS_S:
        for passes in _PASSES:
            one = way(order, dwell_s, turn_s, latitude_deg, noise, passes=passes)
            if one is not None and one.heading.rms_deg <= target_deg:
                yield one
                break
