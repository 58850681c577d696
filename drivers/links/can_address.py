"""Where a CAN bus is found."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Self
from urllib.parse import parse_qsl

from tumble.messages import Message

Option = int | float | str
"""What python-can takes as an option of an interface."""


@dataclass(frozen=True, kw_only=True)
class CanAddress:
    """An interface of python-can, its channel, and its options, for example `slcan`, `COM3`, `{"bitrate": 500000}`.

    As one line of text it is `INTERFACE:CHANNEL?OPTION=VALUE&...`, for example
    `socketcand:can0?host=127.0.0.1&port=29536`, `slcan:/dev/ttyACM0?bitrate=500000`, `socketcan:can0`.
    """

    interface: str
    channel: str
    options: Mapping[str, Option] = field(default_factory=dict)

    @classmethod
    def from_url(cls, url: str) -> Self:
        """Read one line of text. Raises `ValueError` with what is wrong with it."""
        place, _, query = url.partition("?")
        interface, colon, channel = place.partition(":")
        if not (interface and colon and channel):
            raise ValueError(
                Message("{url!r} names no CAN bus; write INTERFACE:CHANNEL, for example socketcan:can0", url=url)
            )
        options = {name: _plain(text) for name, text in parse_qsl(query)}
        return cls(interface=interface, channel=channel, options=options)

    @property
    def url(self) -> str:
        """The address as one line of text."""
        query = "&".join(f"{name}={value}" for name, value in self.options.items())
        return f"{self.interface}:{self.channel}" + (f"?{query}" if query else "")


def _plain(text: str) -> Option:
    """A whole number, a number, or the text itself."""
    for number in (int, float):
        try:
            return number(text)
        except ValueError:
            continue
    return text
