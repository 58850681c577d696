"""What goes wrong at a whole emulated stand: from a script, or told while it is being served."""

from collections.abc import Callable, Sequence
from typing import Final

from tumble.drivers.clock import Clock
from tumble.emulators.faults import Fault, Faults, FaultScript

DEVICES: Final = ("head", "daq", "operator")


class StandFaults:
    """The faults of head, DAQ and operator, and of the bus that they may share.

    Parameters
    ----------
    script
        What shall go wrong; nothing by default.
    clock
        Clock of the world.
    points
        Tells how many dwells have begun in the world.
    """

    def __init__(self, script: FaultScript | None, clock: Clock, points: Callable[[], int]) -> None:
        self._script, self._clock, self._points = script or FaultScript(), clock, points
        self._of = {device: Faults(script, device, clock, points) for device in DEVICES}
        self._buses: list[tuple[Sequence[str], Faults]] = []

    def of(self, device: str) -> Faults:
        """Those of one of `DEVICES`."""
        return self._of[device]

    def of_bus(self, devices: Sequence[str]) -> Faults:
        """Those of a CAN bus that these share.

        Frames are not commands, and of the faults only `drop` and `noise` concern the bus.
        """
        bus = Faults(None, "", self._clock, self._points)
        self._buses.append((devices, bus))
        for fault in self._script.fault:
            _add_to_bus(fault, devices, bus)
        return bus

    def add(self, fault: Fault) -> None:
        """Have one more thing go wrong."""
        self._of[fault.device].add(fault)
        for devices, bus in self._buses:
            _add_to_bus(fault, devices, bus)

    @property
    def happened(self) -> list[tuple[float, Fault]]:
        """What went wrong so far, in order, with the time of the world's clock."""
        everything = [*self._of.values(), *(bus for _, bus in self._buses)]
        return sorted((entry for faults in everything for entry in faults.happened), key=lambda entry: entry[0])


def _add_to_bus(fault: Fault, devices: Sequence[str], bus: Faults) -> None:
    if fault.kind in ("drop", "noise") and fault.device in devices:
        bus.add(fault)
