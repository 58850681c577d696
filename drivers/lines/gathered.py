"""The lines of a block as they come, and what may be wrong with them."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from tumble.drivers.lines.form import Sample
from tumble.drivers.protocols import ChannelBlock
from tumble.messages import Message

_RATE_RATIO: Final = 1.25
_RATE_S: Final = 0.5
"""A block that takes another time than it should by that ratio, and by so many seconds, has another rate."""


@dataclass(kw_only=True)
class Gathered:
    """Good lines, when each came by the stand's clock, and how many others there were."""

    samples: list[Sample] = field(default_factory=list)
    moments_s: list[float] = field(default_factory=list)
    spoilt: int = 0

    def add(self, sample: Sample, moment_s: float, spoilt: int) -> None:
        """Take a good line, with the number of spoilt ones before it."""
        self.samples.append(sample)
        self.moments_s.append(moment_s)
        self.spoilt += spoilt

    def complaint(self, modulus: int) -> str:
        """What is wrong with the block; empty where it is whole. A counter, if there is one, counts up to `modulus`."""
        if self.spoilt:
            return Message.counted(
                "{count} line of a block said nothing", "{count} lines of a block said nothing", count=self.spoilt
            )
        if not modulus:
            return ""
        counts = np.array([sample.count for sample in self.samples], dtype=np.float64)
        wrong = int(np.count_nonzero(np.diff(counts) % modulus != 1))
        if not wrong:
            return ""
        return Message.counted(
            "{wrong} of {count} line did not follow the one before",
            "{wrong} of {count} lines did not follow the one before",
            wrong=wrong,
            count=len(counts),
        )

    def other_rate_hz(self, rate_hz: float) -> float | None:
        """The rate at which the lines came, where that is not `rate_hz`."""
        steps = len(self.moments_s) - 1
        taken_s, planned_s = self.moments_s[-1] - self.moments_s[0], steps / rate_hz
        ratio = max(taken_s, planned_s) / max(min(taken_s, planned_s), 1e-9)
        if ratio <= _RATE_RATIO or abs(taken_s - planned_s) <= _RATE_S:
            return None
        return steps / max(taken_s, 1e-9)

    def block(self, rate_hz: float) -> ChannelBlock:
        """The samples by channel."""
        degc = [sample.temperature_degc for sample in self.samples if sample.temperature_degc is not None]
        return ChannelBlock(
            channels={
                name: np.array([sample.values[name] for sample in self.samples]) for name in self.samples[0].values
            },
            rate_hz=rate_hz,
            device_time_s=self.moments_s[0],
            temperature_degc=float(np.mean(degc)) if degc else None,
        )
