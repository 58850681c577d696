"""The chain from a residual to a name: rivals, experiment, decision, and why it ended."""

from dataclasses import dataclass
from enum import StrEnum
from itertools import takewhile
from typing import Any, Final, Generic

from tumble.calibrations.tracing.link import Link
from tumble.calibrations.tracing.stage import L, Stage
from tumble.messages import Message

FUTILE: Final = 2
"""After so many experiments in a row that separated nothing, none is run any more."""
_PATIENCE: Final = 4
"""After so many that separated nothing, whatever they were parts of, neither."""


class Ended(StrEnum):
    """Why no further experiment is run."""

    NOTHING_TO_TELL = "nothing to tell apart"
    TOLD_APART = "told apart"
    NOTHING_AVAILABLE = "no available experiment"
    NOT_AS_PROMISED = "not as promised"
    ENOUGH = "as many as were asked for"

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return _ENDINGS[self]


_ENDINGS: Final = {
    Ended.NOTHING_TO_TELL: Message("nothing to tell apart"),
    Ended.TOLD_APART: Message("told apart"),
    Ended.NOTHING_AVAILABLE: Message("no available experiment"),
    Ended.NOT_AS_PROMISED: Message("not as promised"),
    Ended.ENOUGH: Message("as many as were asked for"),
}


@dataclass(frozen=True, kw_only=True)
class Chain(Generic[L]):
    """All of it: where it began, every experiment, why it ended."""

    first: Stage[L]
    links: tuple[Link[L], ...] = ()
    ended: Ended | None = None
    """None while it goes on."""
    why: str = ""
    """A sentence or several."""

    @property
    def last(self) -> Stage[L]:
        """What is known now."""
        return self.links[-1].after if self.links else self.first

    @property
    def stages(self) -> tuple[Stage[L], ...]:
        """What was known after each measurement."""
        return (self.first, *(link.after for link in self.links))

    @property
    def doubted(self) -> frozenset[str]:
        """What had rivals before an experiment was run, and these, as far as that was not confirmed since.

        Nothing while anything has rivals still.
        """
        if self.last.disputed:
            return frozenset()
        doubted = {name for link in self.links for names in link.before.disputed for name in names}
        return frozenset(doubted.difference(*(link.experiment.separates for link in self.links if link.confirmed)))

    @property
    def futile(self) -> int:
        """How many experiments in a row have separated nothing, though each was to do so by itself."""
        count = 0
        for link in reversed(self.links):
            if not link.futile:
                break
            count += 1
        return count

    @property
    def in_vain(self) -> tuple[Link[L], ...]:
        """The last experiments in a row that separated nothing, the last one first."""
        return tuple(takewhile(lambda link: not link.separated, reversed(self.links)))

    @property
    def unkept(self) -> bool:
        """Whether a plan of several runs was carried out, or begun anew, and separated nothing in any of them."""
        return len(self.in_vain) >= _PATIENCE or any(
            1 < link.planned <= sum(each.experiment.programme in link.programmes for each in self.in_vain[:since])
            for since, link in enumerate(self.in_vain, start=1)
        )

    def as_json(self) -> dict[str, Any]:
        """What it adds to the document of the loop."""
        return {
            "experiments": [link.as_json() for link in self.links],
            "ended": {"how": self.ended, "why": self.why},
        }
