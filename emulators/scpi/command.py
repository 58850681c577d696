"""An entry of the table of commands."""

from collections.abc import Callable
from dataclasses import dataclass

from tumble.emulators.scpi.language import ScpiError

Reply = str | Callable[[], str | None] | None
"""An answer; or what gives it once all readings are there; or none."""


@dataclass(frozen=True, kw_only=True)
class Command:
    """What a header does, and how many parameters it takes."""

    act: Callable[..., Reply]
    least: int = 0
    most: int = 0
    last: bool = False
    """Whether its answer ends only with the line, so that no query may follow (IEEE 488.2-1992, 6.4.3)."""

    def perform(self, parameters: tuple[str, ...]) -> Reply:
        """Do it. Raises `ScpiError`."""
        if len(parameters) < self.least:
            raise ScpiError(-109)
        if len(parameters) > self.most:
            raise ScpiError(-108)
        return self.act(*parameters)
