"""Putting the frames of one acquisition together, and counting what is missing."""

from statistics import fmean

from tumble.drivers.candaq.frames import Frame

_COUNTS = 256


class Collection:
    """The frames of one acquisition as they come in.

    A frame of another epoch is left over from an earlier acquisition and passed by. The counter of the voltage frames
    must go up by one; a step ahead means lost frames, a step back a doubled one.
    """

    def __init__(self, samples: int, epoch: int) -> None:
        self._samples = samples
        self._epoch = epoch
        self._temperatures_degc: list[float] = []
        self.voltages_v: list[float] = []
        """Voltages so far, in V."""
        self.lost = 0
        """Voltage frames known to be missing."""
        self.doubled = 0
        """Voltage frames that came twice or too late."""
        self.started_s: float | None = None
        """Time of the first sample by the DAQ's clock, where it tells it."""

    def take(self, frame: Frame) -> None:
        """Add a frame."""
        if frame.signals.get("Epoch") != self._epoch:
            return
        if frame.name == "Voltage":
            self._take_voltage(frame)
        elif frame.name == "Temperature":
            self._temperatures_degc.append(frame.number("Temperature"))
        elif frame.name == "Time":
            self.started_s = frame.number("Time")

    @property
    def ended(self) -> bool:
        """Whether the last voltage frame has come or was passed by."""
        return len(self.voltages_v) + self.lost >= self._samples

    @property
    def missing(self) -> int:
        """How many of the voltage frames have not come."""
        return self._samples - len(self.voltages_v)

    @property
    def temperature_degc(self) -> float | None:
        """Mean of the temperature frames; None where none came."""
        return fmean(self._temperatures_degc) if self._temperatures_degc else None

    def _take_voltage(self, frame: Frame) -> None:
        expected = len(self.voltages_v) + self.lost
        ahead = (int(frame.number("Counter")) - expected) % _COUNTS
        if ahead >= _COUNTS // 2 or expected >= self._samples:
            self.doubled += 1
            return
        self.lost += ahead
        self.voltages_v.append(frame.number("Voltage"))
