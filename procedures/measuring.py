"""Taking a dwell: the head goes there, the output settles, samples are taken, and a point comes of them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from tumble.drivers.protocols import HeadStatus, SampleBlock, Stand
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.approach import Place
from tumble.procedures.motion import Motion
from tumble.procedures.recovery import Recovery
from tumble.procedures.reduction import Reduction, reduce_block
from tumble.procedures.settling import acquire, settle
from tumble.procedures.steps import Direction, Dwell, Point


@dataclass(frozen=True, kw_only=True)
class Taken:
    """What was measured at one angle."""

    angle_deg: float
    """As the head reported it."""
    direction: Direction
    began_s: float
    """First sample, by the stand's clock."""
    block: SampleBlock
    reduction: Reduction
    settled: bool

    def point(self, dwell: Dwell, index: int, run_began_s: float) -> Point:
        """The point of `dwell` in a run that began at `run_began_s` by the stand's clock."""
        first_s = self.began_s - run_began_s
        return Point(
            index=index,
            angle_deg=self.angle_deg,
            voltage_v=self.reduction.voltage_v,
            voltage_sd_v=self.reduction.voltage_sd_v,
            samples=self.reduction.samples,
            time_s=first_s + self.reduction.samples / self.block.rate_hz / 2,
            direction=self.direction,
            temperature_degc=self.block.temperature_degc,
            realisation=dwell.realisation,
            procedure=dwell.procedure,
            mount=dwell.mount,
            settled=self.settled,
        )


class Measuring:
    """Takes dwells, each from its beginning where a link is lost in the midst of it.

    `checkpoint` is called while the head moves and while the output settles; see `Motion.travel`.
    """

    def __init__(
        self,
        stand: Stand,
        acquisition: Acquisition,
        motion: Motion,
        recovery: Recovery,
        checkpoint: Callable[[], bool],
    ) -> None:
        self._daq = stand.daq
        self._clock = stand.clock
        self._acquisition = acquisition
        self._motion = motion
        self._recovery = recovery
        self._checkpoint = checkpoint

    def measure(self, angle_deg: float) -> Taken:
        """Measure at an angle. Raises `DeviceError`."""
        go = partial(self._motion.travel, angle_deg, self._checkpoint)
        return self._recovery.persist(partial(self._take, go), self._motion.place)

    def measure_again(self, place: Place) -> Taken:
        """Measure at a place where the head has been, coming there as it did then. Raises `DeviceError`."""
        go = partial(self._motion.return_to, place, self._checkpoint)
        return self._recovery.persist(partial(self._take, go), None)

    def home(self) -> None:
        """Have the head find its reference anew. Raises `DeviceError`."""
        self._move(partial(self._motion.home, self._checkpoint))

    def unwind(self) -> None:
        """Leave the head in the revolution about its zero. Raises `DeviceError`."""
        self._move(partial(self._motion.unwind, self._checkpoint))

    def _move(self, move: Callable[[], None]) -> None:
        self._recovery.persist(self._recovery.using("head")(move), None)

    def _take(self, go: Callable[[], HeadStatus]) -> Taken:
        with self._recovery.using("head"):
            angle_deg = go().angle_deg
        with self._recovery.using("daq"):
            settled = settle(self._daq, self._clock, self._acquisition, self._checkpoint)
            began_s = self._clock.monotonic_s()
            block = acquire(self._daq, self._acquisition.samples, self._acquisition.rate_hz)
        with self._recovery.using("head"):
            self._motion.check_rest(angle_deg)
        return Taken(
            angle_deg=angle_deg,
            direction=self._motion.direction,
            began_s=began_s,
            block=block,
            reduction=reduce_block(block),
            settled=settled,
        )
