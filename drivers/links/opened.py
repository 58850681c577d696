"""The links to the instruments of a stand: opened as its file says, closed together."""

from collections.abc import Callable
from contextlib import ExitStack
from copy import copy
from typing import TYPE_CHECKING, Any, TypeVar

from tumble.drivers.links.places import one_name
from tumble.drivers.tables import OnCan, OnSerialLine

if TYPE_CHECKING:  # opened when needed: neither library is there for nothing
    from tumble.drivers.links.can_link import CanLink
    from tumble.drivers.links.serial_link import SerialLink


Shared = TypeVar("Shared")


class Links:
    """What is open. Instruments on the same CAN bus share it, and so may those on one serial line.

    `check_opening` is called many times a second while one is opened, also anew; what it raises breaks that off.
    """

    def __init__(self, check_opening: Callable[[], object] = lambda: None) -> None:
        self._check_opening = check_opening
        self.check: Callable[[], object] = lambda: None
        """To be called many times a second while an answer is awaited; may raise."""
        self._opened = ExitStack()
        self._buses: dict[str, CanLink] = {}
        self._common: dict[str, Any] = {}

    def checking(self, check: Callable[[], object]) -> "Links":
        """The same, for instruments whose answers are awaited only as long as `check` does not raise."""
        links = copy(self)
        links.check = check
        return links

    def serial(self, table: OnSerialLine, device: str) -> "SerialLink":
        """Open a serial line; errors call the instrument `device`. Raises `LinkLostError`."""
        from tumble.drivers.links.serial_link import SerialLink

        link = SerialLink(table.url, table.baud_rate, device, self.check, self._check_opening)
        self._opened.callback(link.close)
        return link

    def shared(self, place: str, make: Callable[[], Shared]) -> Shared:
        """What the instruments behind one address have in common, made for the first of them."""
        if place not in self._common:
            self._common[place] = make()
        common: Shared = self._common[place]
        return common

    def can(self, table: OnCan) -> "CanLink":
        """The bus of an instrument. Raises `LinkLostError`."""
        from tumble.drivers.links.can_link import CanLink

        address = table.bus
        if address.url not in self._buses:
            self._buses[address.url] = CanLink(address, self._check_opening)
            self._opened.callback(self._buses[address.url].close)
        return self._buses[address.url]

    def name_of(self, url: str) -> str:
        """The one name of a place, see `one_name`, looked up only as long as `check_opening` does not raise."""
        return one_name(url, self._check_opening)

    def at_end(self, close: Callable[[], None]) -> None:
        """Have something else closed with them."""
        self._opened.callback(close)

    def close(self) -> None:
        """Close everything; a second call does nothing."""
        self._opened.close()
