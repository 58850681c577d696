"""Units in which a DBC file may give what is measured, a temperature or a time, and the way to ours and back."""

from typing import Final

from cantools.database.can import Signal

from tumble.drivers.quantities import OURS, TEMPERATURES, VOLTS, Unit, units_of
from tumble.messages import Message

_MICRO: Final = Unit(1e-6)
_SECONDS: Final = {"s": OURS, "sec": OURS, "ms": Unit(1e-3), "us": _MICRO, "µs": _MICRO, "μs": _MICRO}

_WORDS: Final = {"Voltage": Message("voltage"), "Time": Message("time")}


def unit_of(what: str, signal: Signal, channel: str = "") -> Unit:
    """Unit of a signal that tells `what`; ours where it says none, and °C where its unit of temperature is no other.

    What is measured as a `channel` whose name ends with a unit is in one of that quantity. Raises `ValueError` for a
    unit in which no such thing can be.
    """
    unit = (signal.unit or "").strip().casefold()
    if what == "Temperature":
        return TEMPERATURES.get(unit, OURS)
    known = {"Voltage": units_of(channel), "Time": _SECONDS}.get(what)
    if known is None or not unit:
        return OURS
    if unit not in known:
        raise ValueError(
            Message(
                "signal {signal} of the DBC file is in {unit}, which is no unit of a {what}",
                signal=signal.name,
                unit=signal.unit,
                what=_WORDS[what] if known in (VOLTS, _SECONDS) else channel,
            )
        )
    return known[unit]
