"""Units in which a DBC file may give a voltage, a temperature or a time, and the way to ours and back."""

from dataclasses import dataclass
from typing import Final

from cantools.database.can import Signal

from tumble.messages import Message


@dataclass(frozen=True)
class Unit:
    """A unit of V, s or °C: ours is theirs times `scale` plus `offset`."""

    scale: float = 1.0
    offset: float = 0.0

    def to_ours(self, theirs: float) -> float:
        """A value in our unit; the very same where the units are."""
        return theirs if self == OURS else theirs * self.scale + self.offset

    def to_theirs(self, ours: float) -> float:
        """A value in the DBC file's unit."""
        return ours if self == OURS else (ours - self.offset) / self.scale


OURS: Final = Unit()
_FAHRENHEIT: Final = Unit(1.0 / 1.8, -32.0 / 1.8)
_MICRO: Final = Unit(1e-6)
_VOLTS: Final = {"v": OURS, "volt": OURS, "volts": OURS, "mv": Unit(1e-3), "uv": _MICRO, "µv": _MICRO, "μv": _MICRO}
_SECONDS: Final = {"s": OURS, "sec": OURS, "ms": Unit(1e-3), "us": _MICRO, "µs": _MICRO, "μs": _MICRO}
_TEMPERATURES: Final = {"k": Unit(1.0, -273.15), "°f": _FAHRENHEIT, "degf": _FAHRENHEIT}

_WORDS: Final = {"Voltage": Message("voltage"), "Time": Message("time")}


def unit_of(what: str, signal: Signal) -> Unit:
    """Unit of a signal that tells `what`; ours where it says none, and °C where its unit of temperature is no other.

    Raises `ValueError` for a unit in which no voltage or time can be.
    """
    unit = (signal.unit or "").strip().casefold()
    if what == "Temperature":
        return _TEMPERATURES.get(unit, OURS)
    known = {"Voltage": _VOLTS, "Time": _SECONDS}.get(what)
    if known is None or not unit:
        return OURS
    if unit not in known:
        raise ValueError(
            Message(
                "signal {signal} of the DBC file is in {unit}, which is no unit of a {what}",
                signal=signal.name,
                unit=signal.unit,
                what=_WORDS[what],
            )
        )
    return known[unit]
