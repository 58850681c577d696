"""One simulated world behind several emulated instruments."""

from threading import RLock

from tumble.drivers.clock import Clock
from tumble.drivers.simulated import SimulatedStand, SimulatedWorld
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.drivers.simulated.head import SimulatedHead


class SharedWorld:
    """A simulated stand whose head and DAQ are served by different threads, so that both see the same truth.

    The world is not thread safe: whoever touches head, DAQ, world or clock holds `lock` while doing so.
    """

    def __init__(self, stand: SimulatedStand) -> None:
        self.lock = RLock()
        self.world: SimulatedWorld = stand.world
        self.head: SimulatedHead = stand.world.head
        self.daq: SimulatedDaq = stand.world.daq
        self.clock: Clock = stand.stand.clock
