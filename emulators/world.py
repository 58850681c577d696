"""One simulated world behind several emulated instruments."""

from collections.abc import Sequence
from functools import cached_property
from threading import RLock
from typing import Any, Protocol

from tumble.drivers.clock import Clock
from tumble.drivers.protocols import Stand
from tumble.drivers.simulated.head import SimulatedHead
from tumble.drivers.simulated.worlds import Meter, axis_of
from tumble.drivers.tables import HEAD


class Lived(Protocol):
    """A simulated stand and the world behind it."""

    @property
    def stand(self) -> Stand:
        """As an engine sees it."""
        ...

    @property
    def world(self) -> Any:  # noqa: ANN401  # a `World` of whatever kind
        """What is true there."""
        ...


class SharedWorld:
    """A simulated stand whose instruments are served by different threads, so that all see the same truth.

    The world is not thread safe: whoever touches head, DAQ, world or clock holds `lock` while doing so. An emulated
    instrument sees one axis as `head` and the voltmeter at some outputs as `daq`, see `wired_to`.
    """

    def __init__(self, stand: Lived, *, head: str = HEAD, channels: Sequence[str] = ()) -> None:
        self.lock = RLock()
        self.world = stand.world
        self.clock: Clock = stand.stand.clock
        self._stand, self._head, self._channels = stand, head, channels

    def wired_to(self, *, head: str = HEAD, channels: Sequence[str] = ()) -> "SharedWorld":
        """The same world as an instrument sees it that turns one axis, or is wired to some outputs."""
        seen = SharedWorld(self._stand, head=head, channels=channels)
        seen.lock = self.lock
        return seen

    @cached_property
    def head(self) -> SimulatedHead:
        """The axis. Raises `ValueError` where the world has none of its name."""
        return axis_of(self.world.positioners, self._head)

    @cached_property
    def daq(self) -> Meter:
        """The voltmeter. Raises `ValueError` where the world has no such output."""
        meter: Meter = self.world.meter(self._channels)
        return meter
