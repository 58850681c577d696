"""What could be run to answer a question, and which of it is worth most for its time at the stand."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto
from functools import cached_property
from itertools import combinations
from typing import Protocol

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.penalties import NEAR
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.separation import Expected, Outlook, PlannedRows

_RUNS = 3
"""How often a probe is run where once is not enough."""
MOST_RUNS = 6
"""So many are planned in a row at most, where each tells a little."""
_PATIENCE = 30.0
"""More repetitions than this are not advised."""
_TRIED = 3
"""Of so many offers that bring most for a run a longer row is made."""


class Confidence(Enum):
    """How far it can be relied on that rivals are told apart."""

    WHICHEVER = auto()
    """Whichever of the two is true."""
    IF_ONE = auto()
    """If one of the two is true."""
    LIKELY = auto()
    """If one is true, and as likely as not: the table leaves open how large the effects are."""


class Asked(Protocol):
    """What planning needs to know of a question: what could be true, and what rows would tell of it."""

    name: str
    """What was found."""
    rivals: tuple[str, ...]
    """What else it could be."""
    table: PlannedRows
    """The rows that are there."""

    @property
    def needed(self) -> float:
        """Explanations that differ by this in -2 ln L are distinguished."""
        ...

    def expected(self, rows: PlannedRows) -> Expected:
        """What the rows would tell."""
        ...

    def outlook(self, rows: PlannedRows, programme: str, apart: list[int], sure: bool) -> Outlook | None:
        """What the rows of a probe would show of the rivals that it tells apart; None for what has no one signal."""
        ...

    def belongs_to(self, name: str) -> str:
        """Owner of an explanation."""
        ...


@dataclass(frozen=True, kw_only=True)
class Offer:
    """Probes, run one after the other, and what they would tell."""

    question: Asked
    probes: tuple[Probe, ...]
    """In the order in which they are run; some more than once."""
    rows: PlannedRows

    def further(self, *probes: Probe) -> "Offer":
        """The same with more of them."""
        rows = self.rows
        for probe in probes:
            rows = rows.followed_by(probe)
        return Offer(question=self.question, probes=(*self.probes, *probes), rows=rows)

    @property
    def stand_time_s(self) -> float:
        """Time that all of them take."""
        return sum(probe.stand_time_s for probe in self.probes)

    @cached_property
    def expected(self) -> Expected:
        """What it tells of each rival."""
        return self.question.expected(self.rows)

    def promises(self, confidence: Confidence) -> FloatArray:
        """What it tells of each rival, with such confidence."""
        match confidence:
            case Confidence.WHICHEVER:
                return np.asarray(self.expected.promises.min(axis=0))
            case Confidence.IF_ONE:
                return np.asarray(self.expected.promises.max(axis=0))
            case Confidence.LIKELY:
                return np.asarray(self.expected.likely.max(axis=0))

    def needed(self, confidence: Confidence) -> float:
        """Difference in -2 ln L from which on rivals are told apart; to be likely, they must be near no more."""
        return min(self.question.needed, NEAR) if confidence is Confidence.LIKELY else self.question.needed

    def apart(self, among: list[int], confidence: Confidence) -> list[int]:
        """Rivals that it tells apart."""
        promises = self.promises(confidence)
        return [rival for rival in among if promises[rival] >= self.needed(confidence)]

    def worth(self, among: list[int], confidence: Confidence) -> tuple[float, float]:
        """Rivals distinguished per second; of equal ones the clearer, in whole multiples of what is needed."""
        clearness = float(np.clip(self.promises(confidence)[among] // self.needed(confidence), 0, 4).sum())
        return len(self.apart(among, confidence)) / max(self.stand_time_s, 1.0), clearness

    def nearness(self, among: list[int], confidence: Confidence) -> float:
        """How near it comes to telling any of them."""
        return float(self.promises(confidence)[among].max())


def chosen(start: Offer, left: list[int], probes: Sequence[Probe]) -> tuple[Offer, Confidence]:
    """The offer worth most, and how sure it is: what is promised goes before what is likely, few runs before many."""
    single = [start.further(probe) for probe in probes]
    if any(offer.apart(left, Confidence.WHICHEVER) for offer in single):
        return _best(single, left, Confidence.WHICHEVER), Confidence.WHICHEVER
    several = _several(start, single, left)
    for confidence in Confidence:
        for offers in (several, [_summed(start, several, left, confidence)]):
            if any(offer.apart(left, confidence) for offer in offers):
                return _best(offers, left, confidence), confidence
    return max(several, key=lambda offer: offer.nearness(left, Confidence.IF_ONE)), Confidence.IF_ONE


def _best(offers: Sequence[Offer], left: list[int], confidence: Confidence) -> Offer:
    return max(offers, key=lambda offer: offer.worth(left, confidence))


def _several(start: Offer, single: Sequence[Offer], left: list[int]) -> list[Offer]:
    """Single probes, then what promises most several times, or two together. Without any there is one offer, of none.

    What three runs of a probe tell is three times what one does.
    """
    promising = [
        offer for offer in single if offer.nearness(left, Confidence.WHICHEVER) * _RUNS >= offer.question.needed
    ]
    mounted = [probe for offer in single for probe in offer.probes if probe.pairs]
    repeated = [offer.further(*offer.probes * (_RUNS - 1)) for offer in promising]
    return [*single, *repeated, *(start.further(*pair) for pair in combinations(mounted, 2))] or [start]


def _summed(start: Offer, several: Sequence[Offer], left: list[int], confidence: Confidence) -> Offer:
    """One run after the other of what brings most by itself, each time the best, until a rival is distinguished.

    Where even the best brings so little that so many runs would not do, it is left at that.
    """
    now = start.nearness(left, confidence)
    ranked = sorted(several, key=lambda offer: (now - offer.nearness(left, confidence)) / max(len(offer.probes), 1))
    offer, *others = ranked[:_TRIED]
    brings = (offer.nearness(left, confidence) - now) / max(len(offer.probes), 1)
    probes = distinct([probe for each in (offer, *others) for probe in each.probes])
    if now + MOST_RUNS * brings < offer.needed(confidence):
        return offer
    while len(offer.probes) < MOST_RUNS and not offer.apart(left, confidence):
        offer = max((offer.further(probe) for probe in probes), key=lambda each: each.nearness(left, confidence))
    return offer


def runs_needed(question: Asked, left: list[int], start: Offer, nearest: Offer) -> int:
    """How often the nearest offer would have to be run; 0 where that is beyond all reason."""
    now, then = (offer.nearness(left, Confidence.WHICHEVER) for offer in (start, nearest))
    needed = (question.needed - now) / max(then - now, 1e-9)
    return int(np.ceil(needed)) if needed < _PATIENCE else 0


def distinct(probes: Sequence[Probe]) -> list[Probe]:
    """Each probe once, in their order."""
    return list({probe.programme: probe for probe in probes}.values())
