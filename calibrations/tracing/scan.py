"""Which structure without a name a table shows: every component beside what was found already."""

from collections.abc import Sequence
from typing import Final

from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.family import Family, Glance, Proposal
from tumble.calibrations.tracing.gains import Beside
from tumble.calibrations.tracing.penalties import FALSE_ALARM


class Scan:
    """Everything without a name that a table could show, ready to be tried beside anything.

    `chance` is that at which a table without structure is given any, shared by all that is tried.
    """

    def __init__(self, axes: Sequence[Axis], chance: float = FALSE_ALARM) -> None:
        share = chance / 2.0 / max(len(axes), 1)
        expected = chance / 2.0 / max(sum(axis.expected for axis in axes), 1)
        self._families = [Family(axis, share + expected * axis.expected) for axis in axes]
        self._known: dict[bytes, list[Proposal]] = {}

    def proposals(self, beside_: Beside) -> list[Proposal]:
        """The best component of each of the axes that promise most, the best first."""
        if beside_.fingerprint not in self._known:
            self._known[beside_.fingerprint] = _best_of(self._promising(beside_)[:_PROMISING])
        return self._known[beside_.fingerprint]

    def foremost(self, beside_: Beside) -> list[Proposal]:
        """The same of half as many."""
        if beside_.fingerprint in self._known:
            return self._known[beside_.fingerprint]
        return _best_of(self._promising(beside_)[:_FOREMOST])

    def _promising(self, beside_: Beside) -> list[Glance]:
        """Axes in the order of what courses or waves along them explain."""
        return sorted((family.glance(beside_) for family in self._families), key=lambda glance: -glance.gain)


_PROMISING: Final = 16
"""So many axes are tried in every shape: of 60 scans that found anything, what was best was never beyond the seventh,
nor what explained nearly as much beyond the fourteenth."""
_FOREMOST: Final = 8
"""So many are where time is short."""


def _best_of(glances: Sequence[Glance]) -> list[Proposal]:
    found = (glance.best() for glance in glances)
    return sorted((best for best in found if best is not None), key=lambda proposal: -proposal.worth)
