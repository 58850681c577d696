"""What goes wrong at a whole emulated stand: from a script, or told while it is being served."""

from collections.abc import Callable
from typing import Final

from drivers.clock import Clock
from emulators.faults import Fault, Faults, FaultScript

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
        self._of = {device: Faults(script, device, clock, points) for device in DEVICES}
        drops = FaultScript(fault=tuple(fault for fault in (script or FaultScript()).fault if fault.kind == "drop"))
        self._of_bus = {device: Faults(drops, device, clock, points) for device in DEVICES}

    def of(self, device: str) -> Faults:
        """Those of one of `DEVICES`."""
        return self._of[device]

    def of_bus(self, device: str) -> Faults:
        """Those that a CAN bus has in place of an instrument: frames are not commands, and only `drop` concerns it."""
        return self._of_bus[device]

    def add(self, fault: Fault) -> None:
        """Have one more thing go wrong."""
        self._of[fault.device].add(fault)
        if fault.kind == "drop":
            self._of_bus[fault.device].add(fault)

    @property
    def happened(self) -> list[tuple[float, Fault]]:
        """What went wrong so far, in order, with the time of the world's clock."""
        everything = [*self._of.values(), *self._of_bus.values()]
        return sorted((entry for faults in everything for entry in faults.happened), key=lambda entry: entry[0])
