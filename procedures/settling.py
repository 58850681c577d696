"""Waiting until the outputs have come to rest."""

import math
from collections.abc import Callable, Mapping
from typing import TypeAlias

from tumble.drivers.clock import Clock
from tumble.drivers.protocols import FloatArray
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.reduction import reduce_channels
from tumble.procedures.steps import Reading

RESOLUTION = 1e-6
"""Means that differ by less agree in any case: without noise a standard error would be no measure."""

Take: TypeAlias = Callable[[int, float], Mapping[str, FloatArray]]
"""Takes so many samples at a rate in Hz; returns them by channel."""


def settle(take: Take, clock: Clock, acquisition: Acquisition, checkpoint: Callable[[], object]) -> bool:
    """Take blocks until two consecutive ones agree in every channel; false where the time for it ran out first.

    `checkpoint` is called before every block, and may wait or raise.
    """
    clock.sleep(acquisition.settle_s)
    deadline_s = clock.monotonic_s() + acquisition.settle_timeout_s
    most = max(2, math.ceil(acquisition.settle_timeout_s * acquisition.rate_hz / acquisition.settle_samples))
    previous: dict[str, Reading] | None = None
    for _ in range(most):
        checkpoint()
        current = reduce_channels(take(acquisition.settle_samples, acquisition.rate_hz))
        if previous is not None and _at_rest(previous, current, acquisition):
            return True
        if clock.monotonic_s() >= deadline_s:
            break
        previous = current
    return False


def _at_rest(previous: Mapping[str, Reading], current: Mapping[str, Reading], acquisition: Acquisition) -> bool:
    within, change = acquisition.settle_within, acquisition.settle_change
    return (
        all(agree(previous[name], current[name], acquisition) for name in current)
        and all(abs(current[name].mean) <= within[name] for name in within.keys() & current.keys())
        and all(
            abs(current[name].mean - previous[name].mean) <= change[name] for name in change.keys() & current.keys()
        )
    )


def agree(first: Reading, second: Reading, acquisition: Acquisition) -> bool:
    """Whether two blocks have the same mean, by the criterion stated in `Acquisition`; never where one is unusable."""
    allowed = acquisition.settle_tolerance_v
    if allowed is None:
        variance = first.sd**2 / first.samples + second.sd**2 / second.samples
        allowed = max(acquisition.settle_tolerance * math.sqrt(variance), RESOLUTION)
    return abs(second.mean - first.mean) <= allowed
