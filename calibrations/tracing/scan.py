"""Which structure without a name a table shows: every component beside what was found already."""

from collections.abc import Sequence
from typing import Final

from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.family import Family, Proposal
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
        """The best component of every axis that shows any, the best first."""
        if beside_.fingerprint not in self._known:
            self._known[beside_.fingerprint] = _best_of(self._families, beside_)
        return self._known[beside_.fingerprint]

    def foremost(self, beside_: Beside) -> list[Proposal]:
        """The same of those axes alone along which courses or waves explain most, in a third of the time."""
        if beside_.fingerprint in self._known:
            return self._known[beside_.fingerprint]
        ranked = sorted(self._families, key=lambda family: -family.at_a_glance(beside_))
        return _best_of(ranked[:_FOREMOST], beside_)


_FOREMOST: Final = 8
"""So many axes are tried in every shape where time is short."""


def _best_of(families: Sequence[Family], beside_: Beside) -> list[Proposal]:
    found = (family.best(beside_) for family in families)
    told = [best for best in found if best is not None and best.gain > 0.0]
    return sorted(told, key=lambda proposal: -proposal.worth)
