"""Taking a dwell: the positioners go there, the outputs settle, samples are taken, and a point comes of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

from tumble.drivers.protocols import Block, Stand
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.approach import Place
from tumble.procedures.axes import Axes
from tumble.procedures.exciters import Exciters
from tumble.procedures.recovery import Recovery
from tumble.procedures.reduction import count_unusable, reduce_channels, with_temperatures
from tumble.procedures.sampling import Sampling, channels_of, wanted
from tumble.procedures.settling import settle
from tumble.procedures.steps import Direction, Dwell, Point, Reading


@dataclass(frozen=True, kw_only=True)
class Taken:
    """What was measured in one place."""

    positions_deg: Mapping[str, float]
    """As the positioners reported them."""
    directions: Mapping[str, Direction]
    began_s: float
    """First sample, by the stand's clock."""
    blocks: tuple[Block, ...]
    """Of every sampler."""
    readings: Mapping[str, Reading]
    settled: bool

    @property
    def unusable(self) -> int:
        """How many samples are not finite, or overloads."""
        return sum(count_unusable(values) for values in channels_of(self.blocks).values())

    @property
    def samples(self) -> int:
        """How many samples there are, of all channels together."""
        return sum(len(values) for values in channels_of(self.blocks).values())

    @property
    def temperature_degc(self) -> float | None:
        """Of the first sampler that has a thermometer."""
        return next((it.temperature_degc for it in self.blocks if it.temperature_degc is not None), None)

    def point(self, dwell: Dwell, index: int, run_began_s: float, take: int = 1) -> Point:
        """The point of `dwell` in a run that began at `run_began_s` by the stand's clock."""
        first_s = self.began_s - run_began_s
        return Point(
            index=index,
            positions_deg=self.positions_deg,
            directions=self.directions,
            readings=self.readings,
            time_s=first_s + sum(_duration_s(block) for block in self.blocks) / 2,
            temperature_degc=self.temperature_degc,
            procedure=dwell.procedure,
            realisation=dwell.realisation,
            conditions=dwell.conditions,
            settled=self.settled,
            take=take,
        )


class Measuring:
    """Takes dwells, each from its beginning where a link is lost in the midst of it.

    `checkpoint` is called while a positioner moves and while the outputs settle; see `Motion.travel`.
    """

    def __init__(
        self,
        stand: Stand,
        acquisition: Acquisition,
        axes: Axes,
        sampling: Sampling,
        exciters: Exciters,
        recovery: Recovery,
        checkpoint: Callable[[], bool],
    ) -> None:
        self._clock = stand.clock
        self._acquisition = acquisition
        self._axes = axes
        self._sampling = sampling
        self._exciters = exciters
        self._recovery = recovery
        self._checkpoint = checkpoint

    def measure(self, dwell: Dwell) -> Taken:
        """Measure where a dwell says. Raises `DeviceError`."""
        go = partial(self._axes.travel, dwell.targets_deg, self._checkpoint)
        return self._recovery.persist(partial(self._take, go, dwell.channels, dwell.further), self._axes.places)

    def retake(self, dwell: Dwell, point: Point) -> Taken:
        """Measure the dwell of a point once more, coming there as then. Raises `DeviceError`."""
        places = {
            name: Place(angle_deg=target_deg, direction=point.directions[name])
            for name, target_deg in dwell.targets_deg.items()
        }
        go = partial(self._axes.return_to, places, self._checkpoint)
        return self._recovery.persist(partial(self._take, go, dwell.channels, dwell.further), self._axes.places)

    def measure_again(self, point: Point) -> Taken:
        """Measure where a point was taken, coming there as then. Raises `DeviceError`."""
        places = {
            name: Place(angle_deg=angle_deg, direction=point.directions[name])
            for name, angle_deg in point.positions_deg.items()
        }
        go = partial(self._axes.return_to, places, self._checkpoint)
        return self._recovery.persist(partial(self._take, go, tuple(point.readings)))

    def home(self) -> None:
        """Have all positioners find their references anew. Raises `DeviceError`."""
        self._recovery.persist(partial(self._axes.home, self._checkpoint))

    def unwind(self) -> None:
        """Leave every positioner in the revolution about its zero. Raises `DeviceError`."""
        self._recovery.persist(partial(self._axes.unwind, self._checkpoint))

    def _take(
        self, go: Callable[[], dict[str, float]], channels: tuple[str, ...], further: tuple[str, ...] = ()
    ) -> Taken:
        positions_deg = go()
        self._exciters.sustain()
        settled = settle(self._sampling.channels, self._clock, self._acquisition, self._checkpoint)
        began_s = self._clock.monotonic_s()
        blocks = self._sampling.blocks(self._acquisition.samples, self._acquisition.rate_hz)
        self._axes.check_rest(positions_deg)
        self._exciters.inspect(blocks)
        sampled = channels_of(blocks)
        kept = wanted(sampled, channels) | {name: sampled[name] for name in further if name in sampled}
        return Taken(
            positions_deg=positions_deg,
            directions=self._axes.directions(positions_deg),
            began_s=began_s,
            blocks=blocks,
            readings=with_temperatures(reduce_channels(kept), blocks),
            settled=settled,
        )


def _duration_s(block: Block) -> float:
    """From the first sample of a block to the time of the one that would be next."""
    return max(map(len, block.channels.values()), default=0) / block.rate_hz
