"""Which instruments' links were lost and have not been recovered yet, and whose fault an error is."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError, naming
from tumble.procedures.errors import StopRequestedError


class Losses:
    """Names of the instruments that nobody could hear for a while: what they did meanwhile is unknown.

    `title` is what sentences call an instrument, by its name.
    """

    def __init__(self, title: Callable[[str], str] = str) -> None:
        self.names: set[str] = set()
        self.unheard: set[str] = set()
        """Those, and the ones that gave no answer, or none before somebody had the wait for it broken off."""
        self._title = title

    @contextmanager
    def using(self, name: str) -> Iterator[None]:
        """Name the instrument in a `DeviceError`, and note whose link it was that a `LinkLostError` tells of."""
        try:
            with naming(name, self._title(name)):
                yield
        except DeviceError as error:
            self._note(name, error)
            raise
        except StopRequestedError:
            self.unheard.add(name)
            raise

    def forget(self) -> None:
        """All are back."""
        self.names.clear()
        self.unheard.clear()

    def _note(self, name: str, error: DeviceError) -> None:
        if error.instrument != name:  # it was used on behalf of this one
            return
        if isinstance(error, LinkLostError):
            self.names.add(name)
        if isinstance(error, LinkLostError | NoReplyError):
            self.unheard.add(name)
