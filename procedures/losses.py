"""Which instruments' links were lost and have not been recovered yet."""

from collections.abc import Iterator
from contextlib import contextmanager

from tumble.drivers.errors import LinkLostError


class Losses:
    """Names of the instruments that nobody could hear for a while: what they did meanwhile is unknown."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    @contextmanager
    def using(self, name: str) -> Iterator[None]:
        """Note whose link it was that a `LinkLostError` tells of."""
        try:
            yield
        except LinkLostError:
            self.names.add(name)
            raise
