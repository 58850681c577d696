"""Waiting until the output has come to rest."""

import math
from collections.abc import Callable

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Daq, SampleBlock
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.reduction import Reduction, reduce_block

RESOLUTION_V = 1e-6
"""Means that differ by less agree in any case: without noise a standard error would be no measure."""


def settle(daq: Daq, clock: Clock, acquisition: Acquisition, checkpoint: Callable[[], object]) -> bool:
    """Take blocks until two consecutive ones agree; false where the time for it ran out first.

    `checkpoint` is called before every block, and may wait or raise.
    """
    clock.sleep(acquisition.settle_s)
    deadline_s = clock.monotonic_s() + acquisition.settle_timeout_s
    most = max(2, math.ceil(acquisition.settle_timeout_s * acquisition.rate_hz / acquisition.settle_samples))
    previous: Reduction | None = None
    for _ in range(most):
        checkpoint()
        current = reduce_block(acquire(daq, acquisition.settle_samples, acquisition.rate_hz))
        if previous is not None and agree(previous, current, acquisition):
            return True
        if clock.monotonic_s() >= deadline_s:
            break
        previous = current
    return False


def agree(first: Reduction, second: Reduction, acquisition: Acquisition) -> bool:
    """Whether two blocks have the same mean, by the criterion stated in `Acquisition`; never where one is unusable."""
    allowed_v = acquisition.settle_tolerance_v
    if allowed_v is None:
        variance = first.voltage_sd_v**2 / first.samples + second.voltage_sd_v**2 / second.samples
        allowed_v = max(acquisition.settle_tolerance * math.sqrt(variance), RESOLUTION_V)
    return abs(second.voltage_v - first.voltage_v) <= allowed_v


def acquire(daq: Daq, samples: int, rate_hz: float) -> SampleBlock:
    """Acquire a block and make sure that it is complete. Raises `DeviceError`."""
    block = daq.acquire(samples, rate_hz)
    if len(block.voltage_v) != samples:
        happened = f"gave {len(block.voltage_v)} of {samples} samples"
        raise DeviceError("DAQ", happened, "check its trigger and its connection, then resume the run")
    return block
