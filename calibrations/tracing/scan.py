"""Which structure without a name a table shows: every component beside what was found already."""

from collections.abc import Sequence

from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.family import Family, Proposal
from tumble.calibrations.tracing.gains import Beside


class Scan:
    """Everything without a name that a table could show, ready to be tried beside anything.

    `chance` is that at which a table without structure is given any, shared by all that is tried.
    """

    def __init__(self, axes: Sequence[Axis], chance: float) -> None:
        share = chance / 2.0 / max(len(axes), 1)
        expected = chance / 2.0 / max(sum(axis.expected for axis in axes), 1)
        self._families = [Family(axis, share + expected * axis.expected) for axis in axes]

    def proposals(self, beside_: Beside) -> list[Proposal]:
        """The best component of every axis that shows any, the best first."""
        found = (family.best(beside_) for family in self._families)
        told = [best for best in found if best is not None and best.gain > 0.0]
        return sorted(told, key=lambda proposal: -proposal.worth)
