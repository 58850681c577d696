"""Channels and axes as an operator reads them: their names in tables end in their units."""

from typing import Final

from tumble.window.look.names import in_words, instrument_name

_UNITS: Final = {"_deg_h": "°/h", "_degc": "°C", "_deg": "°", "_hpa": "hPa", "_hz": "Hz", "_v": "V"}
"""Units by the ends of names, the longer ones of a kind first."""


def channel_parts(name: str) -> tuple[str, str]:
    """What a channel gives, in words, and its unit; empty where its name ends in none."""
    end = next((each for each in _UNITS if name.endswith(each)), "")
    words = in_words(name)
    return (name.removesuffix(end) if words == name else words), _UNITS.get(end, "")


def channel_text(name: str) -> str:
    """Both, as in a heading."""
    words, unit = channel_parts(name)
    return f"{words} ({unit})" if unit else words


def axis_text(positioner: str) -> str:
    """The angle of a positioner, as in a heading."""
    return f"{instrument_name(positioner)} (°)"
