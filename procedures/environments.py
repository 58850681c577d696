"""The environments of a stand: what sets a condition of dwells by itself, where else a person would be asked."""

from collections.abc import Callable, Collection
from functools import partial

from tumble.drivers.protocols import Stand
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.interlock import Interlock
from tumble.procedures.losses import Losses
from tumble.procedures.recovery import Recovery
from tumble.procedures.reduction import reduce_channels
from tumble.procedures.sampling import Sampling, channels_of
from tumble.procedures.soaking import Seen, Soaking


class Environments:
    """Soaks the unit, each time from the beginning where a link is lost in the midst of it.

    `interlock` leaves them safe at the end of the run. `check` is called while it is waited for, and raises where the
    run should end.
    """

    def __init__(
        self,
        stand: Stand,
        acquisition: Acquisition,
        sampling: Sampling,
        recovery: Recovery,
        losses: Losses,
        interlock: Interlock,
        check: Callable[[], object],
    ) -> None:
        self._stand, self._acquisition, self._sampling = stand, acquisition, sampling
        self._recovery, self._losses = recovery, losses
        self._interlock, self._check = interlock, check

    @property
    def names(self) -> Collection[str]:
        """The conditions that they set."""
        return self._stand.environments.keys()

    def soak(self, condition: str, setpoint_degc: float) -> str:
        """Bring the unit to a temperature; returns what came of it, in words. Raises `DeviceError`."""
        self._interlock.used.add(condition)
        return self._recovery.persist(partial(self._soak, condition, setpoint_degc))

    def _soak(self, condition: str, setpoint_degc: float) -> str:
        soaking = Soaking(
            self._stand.environments[condition],
            self._stand.title(condition),
            self._stand.clock,
            self._acquisition.soak,
            self._seen,
            self._check,
        )
        with self._losses.using(condition):
            return soaking.carry_out(setpoint_degc)

    def _seen(self) -> Seen:
        """Short blocks of all channels, and the temperatures that come with them."""
        blocks = self._sampling.blocks(self._acquisition.settle_samples, self._acquisition.rate_hz)
        readings = reduce_channels(channels_of(blocks))
        own_degc = {name: degc for block in blocks for name, degc in block.temperatures_degc.items()}
        common_degc = {str(number): block.temperature_degc for number, block in enumerate(blocks)}
        known_degc = own_degc or {name: degc for name, degc in common_degc.items() if degc is not None}
        return Seen(outputs_v={name: reading.mean for name, reading in readings.items()}, temperatures_degc=known_degc)
