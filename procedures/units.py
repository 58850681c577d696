"""The unit of a channel, which its name ends with."""

from collections.abc import Mapping
from typing import Final

_UNITS: Final[Mapping[str, str]] = {"v": "V", "g": "g", "deg": "°", "deg_h": "°/h", "m_s2": "m/s²", "degc": "°C"}


def unit_of(channel: str) -> str:
    """Unit in which a channel is given: `V` for `voltage_v`; the channel's name where that tells of no known unit."""
    parts = channel.split("_")
    ends = ("_".join(parts[number:]) for number in range(1, len(parts)))
    return next((_UNITS[end] for end in ends if end in _UNITS), channel)
