"""The links to the instruments of a stand: opened as its file says, closed together."""

from contextlib import ExitStack
from typing import TYPE_CHECKING

from app.instruments import Instrument
from procedures.errors import InputError

if TYPE_CHECKING:
    from drivers.links import SerialLink
    from drivers.links.can_address import CanAddress
    from drivers.links.can_link import CanLink


class Links:
    """What is open. Instruments on the same CAN bus share it."""

    def __init__(self) -> None:
        self._opened = ExitStack()
        self._buses: dict[str, CanLink] = {}

    def serial(self, table: Instrument, device: str) -> "SerialLink":
        """Open a serial line; errors call the instrument `device`. Raises `LinkLostError`."""
        from drivers.links import SerialLink

        link = SerialLink(table.url, table.baud_rate, device)
        self._opened.callback(link.close)
        return link

    def can(self, table: Instrument) -> "CanLink":
        """The bus of an instrument. Raises `InputError`, `LinkLostError`."""
        from drivers.links.can_link import CanLink

        address = _can_address(table)
        if address.url not in self._buses:
            self._buses[address.url] = CanLink(address)
            self._opened.callback(self._buses[address.url].close)
        return self._buses[address.url]

    def close(self) -> None:
        """Close everything; a second call does nothing."""
        self._opened.close()


def _can_address(table: Instrument) -> "CanAddress":
    from drivers.links.can_address import CanAddress

    if not table.url:
        return CanAddress(interface=table.interface, channel=table.channel, options=table.options)
    try:
        return CanAddress.from_url(table.url)
    except ValueError as error:
        raise InputError(f"the stand file: url: {error}") from error
