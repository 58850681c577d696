"""What a link or an instrument dropped or tried again, counted so that it can be told."""

from threading import Lock
from typing import Final

from tumble.messages import Message

TOLD_EVERY: Final = 10
"""A number is told again once it is so many times as great."""
_LONGEST_EXAMPLE: Final = 60


class Tally:
    """Counts by what happened; may be used from several threads.

    Parameters
    ----------
    place
        Where it happened, as the sentences begin.
    """

    def __init__(self, place: str) -> None:
        self._place = place
        self._lock = Lock()
        self._counts: dict[str, int] = {}
        self._first: dict[str, str] = {}
        self._told: dict[str, int] = {}

    def count(self, what: str, example: str = "") -> None:
        """Count one more of `what`, for example `cut frames dropped`; the first example is told along with it."""
        with self._lock:
            self._counts[what] = self._counts.get(what, 0) + 1
            self._first.setdefault(what, example[:_LONGEST_EXAMPLE])

    def remarks(self) -> tuple[str, ...]:
        """A sentence on what is new, or ten times as frequent as when it was told last."""
        return self._telling(TOLD_EVERY)

    def last_remarks(self) -> tuple[str, ...]:
        """A sentence on whatever has grown since it was told last."""
        return self._telling(1)

    @property
    def words(self) -> str:
        """Everything so far in a few words; empty where there is nothing."""
        with self._lock:
            counts = [Message("{what}: {times}", what=what, times=times) for what, times in self._counts.items()]
            return Message.joined(", ", counts) if counts else ""

    def _telling(self, times: int) -> tuple[str, ...]:
        with self._lock:
            due = [what for what, count in self._counts.items() if self._due(what, count, times)]
            self._told |= {what: self._counts[what] for what in due}
            return tuple(map(self._sentence, due))

    def _sentence(self, what: str) -> str:
        said = Message("{place}: {what}: {times}", place=self._place, what=what, times=self._counts[what])
        example = self._first[what]
        return Message("{said} (the first: {example})", said=said, example=example) if example else said

    def _due(self, what: str, count: int, times: int) -> bool:
        told = self._told.get(what, 0)
        return count > told and count >= times * told
