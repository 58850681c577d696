"""What goes wrong at a whole emulated stand: from a script, or told while it is being served."""

from collections.abc import Callable, Collection, Sequence
from typing import Final

from tumble.drivers.clock import Clock
from tumble.emulators.faults import Fault, Faults, FaultScript
from tumble.messages import Message

OPERATOR: Final = "operator"


class StandFaults:
    """The faults of all instruments of a stand and of its operator, and of the bus that some may share.

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
        self._of: dict[str, Faults] = {}
        self._buses: list[tuple[Sequence[str], Faults]] = []

    def of(self, device: str) -> Faults:
        """Those of an instrument by its name at the stand, or of the `operator`."""
        if device not in self._of:
            self._of[device] = Faults(self._script, device, self._clock, self._points)
        return self._of[device]

    def check(self, instruments: Collection[str]) -> None:
        """Make sure that everything goes wrong in an instrument that there is. Raises `ValueError`."""
        known = [*instruments, OPERATOR]
        for fault in self._script.fault:
            if fault.device not in known:
                raise ValueError(
                    Message(
                        "a fault is to happen in {device}, and the stand has {known}; correct the fault file",
                        device=fault.device,
                        known=", ".join(known),
                    )
                )

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
        self.of(fault.device).add(fault)
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
