"""How a dwell is taken: how long it lasts and when it may begin."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from tumble.procedures.approach import EITHER_WAY, Approach
from tumble.procedures.soaking import Soak


@dataclass(frozen=True, kw_only=True)
class Acquisition:
    """Settings of every dwell of a run.

    After a move the output has `settle_s` to come to rest. Then blocks of `settle_samples` are taken until the means of
    two consecutive ones agree: they differ by no more than `settle_tolerance` standard errors of their difference, or,
    where `settle_tolerance_v` is given, by no more than so many volts. A channel named in `settle_within` must be as
    near zero besides, one named in `settle_change` as near its mean before. After `settle_timeout_s` the dwell is taken
    in any case and its point marked as not settled.
    """

    samples: int
    """Number of samples in a dwell, at least 2."""
    rate_hz: float
    position_tolerance_deg: float = 0.01
    """How far from the commanded angle the head may report itself and be there."""
    approach: Approach = EITHER_WAY
    settle_s: float = 0.0
    settle_samples: int = 10
    """Number of samples in a block, at least 2."""
    settle_tolerance: float = 3.0
    settle_tolerance_v: float | None = None
    settle_within: Mapping[str, float] = field(default_factory=dict)
    """How far from zero the mean of a channel may be, in its unit, by the channels of the stand that are named here."""
    settle_change: Mapping[str, float] = field(default_factory=dict)
    """By how much two consecutive means of a channel may differ in any case, likewise."""
    settle_timeout_s: float = 10.0
    soak: Soak = field(default_factory=Soak)
    """When a unit has taken on a temperature, before dwells that need one."""

    @property
    def dwell_s(self) -> float:
        """Duration of a dwell."""
        return self.samples / self.rate_hz

    @property
    def planned_settling_s(self) -> float:
        """Time that settling takes where the first two blocks agree."""
        return self.settle_s + 2 * self.settle_samples / self.rate_hz
