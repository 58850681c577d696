"""Units in which a DBC file may give a voltage, a temperature or a time, and the way to ours."""

from collections.abc import Callable
from typing import Final

from cantools.database.can import Signal

Convert = Callable[[float], float]

_SCALES: Final = {
    "Voltage": {
        "": 1.0,
        "v": 1.0,
        "volt": 1.0,
        "volts": 1.0,
        "mv": 1e-3,
        "uv": 1e-6,
        "µv": 1e-6,
        "μv": 1e-6,
        "kv": 1e3,
    },
    "Time": {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6},
}
_TO_DEGC: Final[dict[str, Convert]] = {
    "k": lambda kelvin: kelvin - 273.15,
    "°f": lambda fahrenheit: (fahrenheit - 32.0) / 1.8,
    "degf": lambda fahrenheit: (fahrenheit - 32.0) / 1.8,
}


def to_our_unit(what: str, signal: Signal) -> Convert | None:
    """How a value of a signal becomes V, s or °C; None where it is that already.

    Raises `ValueError` for a unit in which no voltage or time can be.
    """
    unit = (signal.unit or "").strip().casefold()
    if what not in _SCALES:
        return _TO_DEGC.get(unit) if what == "Temperature" else None
    scale = _SCALES[what].get(unit)
    if scale is None:
        raise ValueError(
            f"signal {signal.name} of the DBC file is in {signal.unit}, which is no unit of a {what.lower()}"
        )
    return None if scale == 1.0 else lambda value: value * scale
