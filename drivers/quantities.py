"""Units in which an instrument may tell a quantity, and the way to the unit that the name of its channel ends with."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np

from tumble.messages import Message


@dataclass(frozen=True)
class Unit:
    """A unit of the same quantity as ours: ours is theirs times `scale` plus `offset`."""

    scale: float = 1.0
    offset: float = 0.0

    def to_ours(self, theirs: float) -> float:
        """A value in our unit; the very same where the units are."""
        return theirs if self == OURS else theirs * self.scale + self.offset

    def to_theirs(self, ours: float) -> float:
        """A value in their unit."""
        return ours if self == OURS else (ours - self.offset) / self.scale


OURS: Final = Unit()
_MICRO: Final = Unit(1e-6)
VOLTS: Final = {"v": OURS, "volt": OURS, "volts": OURS, "mv": Unit(1e-3), "uv": _MICRO, "µv": _MICRO, "μv": _MICRO}
TEMPERATURES: Final = {
    "degc": OURS,
    "°c": OURS,
    "c": OURS,
    "k": Unit(1.0, -273.15),
    "°f": Unit(1.0 / 1.8, -32.0 / 1.8),
    "degf": Unit(1.0 / 1.8, -32.0 / 1.8),
}
_DEG: Final = float(np.rad2deg(1.0))
_ANGLES: Final = {
    "deg": OURS,
    "°": OURS,
    "arcmin": Unit(1.0 / 60.0),
    "arcsec": Unit(1.0 / 3600.0),
    "mrad": Unit(1e-3 * _DEG),
    "rad": Unit(_DEG),
}
_RATES: Final = {
    "deg/h": OURS,
    "°/h": OURS,
    "arcsec/s": OURS,
    "deg/s": Unit(3600.0),
    "°/s": Unit(3600.0),
    "mrad/s": Unit(3.6 * _DEG),
    "rad/s": Unit(3600.0 * _DEG),
}
_BY_ENDING: Final = MappingProxyType({"_deg_h": _RATES, "_deg": _ANGLES, "_degc": TEMPERATURES, "_v": VOLTS})
"""Longer endings first."""


def units_of(channel: str) -> Mapping[str, Unit]:
    """Units of the quantity that the name of a channel ends with, in small letters; volts where it ends with none."""
    return next((units for ending, units in _BY_ENDING.items() if channel.endswith(ending)), VOLTS)


def unit_called(name: str, channel: str) -> Unit:
    """The unit of this name for a channel; ours where it is empty. Raises `ValueError` where there is none."""
    units, wanted = units_of(channel), name.strip().casefold()
    if wanted and wanted not in units:
        raise ValueError(
            Message(
                "{unit} is no unit of {channel}; known are {known}", unit=name, channel=channel, known=", ".join(units)
            )
        )
    return units[wanted] if wanted else OURS
