"""What clients hear of emulated Zaber stages on one line."""

from collections.abc import Sequence
from typing import Protocol


class Stage(Protocol):
    """A stage of a chain."""

    def hear(self, line: bytes) -> bytes:
        """Answer one line; silence where it is not for this stage, or garbled."""
        ...

    def alert(self, arrivals_known: int) -> tuple[bytes, int]:
        """What a client that knows of so many arrivals is to be told unasked, and of how many it knows then."""
        ...


class ZaberChain:
    """What one client hears of all stages on a line. Fits `tumble.emulators.serving.Session`."""

    def __init__(self, stages: Sequence[Stage]) -> None:
        self._stages = stages
        self._arrivals: Sequence[int] = [stage.alert(0)[1] for stage in stages]

    def received(self, data: bytes) -> bytes:
        """Every stage hears the line; those that are meant answer."""
        return b"".join(stage.hear(data) for stage in self._stages)

    def due(self) -> bytes:
        """An alert of every stage of which an axis has come to rest since the last look."""
        alerts, self._arrivals = zip(
            *(stage.alert(known) for stage, known in zip(self._stages, self._arrivals, strict=True)), strict=True
        )
        return b"".join(alerts)
