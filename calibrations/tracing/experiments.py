"""Which experiment would tell apart what a table cannot: chosen by what the rivals predict for it."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import Protocol

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.experiment_sentences import no_programme, promised, qualified, remedied
from tumble.calibrations.tracing.places import PlaceQuestion, places
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.separation import (
    Expected,
    Outlook,
    PlannedRows,
    Question,
)
from tumble.calibrations.tracing.table import Extensible
from tumble.calibrations.tracing.trace import Trace

_RUNS = 3
"""How often a probe is run where once is not enough."""
MOST_RUNS = 6
"""So many are planned in a row at most, where each tells a little."""
_PATIENCE = 30.0
"""More repetitions than this are not advised."""
_TRIED = 3
"""Of so many offers that bring most for a run a longer row is made."""


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """What to measure next, and why."""

    separates: tuple[str, ...]
    """The effect that was found, and the rivals that this would tell from it."""
    programme: str
    """Name of a programme that comes along; empty where none would help."""
    why: str
    command: str
    """What to type; empty where no programme would help."""
    separation: float
    """Expected difference in -2 ln L, that of the closest of the rivals."""
    stand_time_s: float
    least: float = 0.0
    """What that will hardly stay below: less than the expectation by what the table leaves open of its causes."""
    runs: int = 1
    """How often it is to be run; the stand time is that of all of them."""
    together: tuple[str, ...] = ()
    """Programmes without which it tells nothing apart."""
    outlook: Outlook | None = None
    """What it would show; None where no programme would help."""
    remedy: str = ""
    """What would help where no programme does; empty where nothing is known to."""


def next_experiments(
    base: Extensible, trace: Trace, close: Mapping[str, Sequence[Rival]], probes: Sequence[Probe], otherwise: str = ""
) -> tuple[Experiment, ...]:
    """For every effect that has rivals: the experiments that tell it from them, in the least time.

    `close` holds the rivals of each effect of the trace by name, `probes` what can be run. Where none of them helps,
    the experiment says so, with what to do `otherwise`, and has no command.
    """
    questions = [Question(base, trace, name, rivals) for name, rivals in close.items() if rivals]
    return tuple(experiment for question in questions for experiment in _answers(question, probes, otherwise))


def locating_experiments(
    base: Extensible, trace: Trace, others: Sequence[Trace], probes: Sequence[Probe], otherwise: str = ""
) -> tuple[Experiment, ...]:
    """Experiments that tell on which variable structure without a name lives.

    `others` are explanations with the structure elsewhere, from which the table does not part it.
    """
    if len(places(trace, others)) < 2:
        return ()
    return tuple(_answers(PlaceQuestion(base, trace, others), probes, otherwise))


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
class _Offer:
    """Probes, run one after the other, and what they would tell."""

    question: Asked
    probes: tuple[Probe, ...]
    """In the order in which they are run; some more than once."""
    rows: PlannedRows

    def further(self, *probes: Probe) -> "_Offer":
        """The same with more of them."""
        rows = self.rows
        for probe in probes:
            rows = rows.followed_by(probe)
        return _Offer(question=self.question, probes=(*self.probes, *probes), rows=rows)

    @property
    def stand_time_s(self) -> float:
        return sum(probe.stand_time_s for probe in self.probes)

    @cached_property
    def expected(self) -> Expected:
        """What it tells of each rival."""
        return self.question.expected(self.rows)

    def promises(self, sure: bool) -> FloatArray:
        """What it tells of each rival at least: whichever is true, or if one of the two is."""
        promises = self.expected.promises
        return np.asarray(promises.min(axis=0) if sure else promises.max(axis=0))

    def apart(self, among: list[int], sure: bool) -> list[int]:
        """Rivals that it tells apart."""
        promises = self.promises(sure)
        return [rival for rival in among if promises[rival] >= self.question.needed]

    def worth(self, among: list[int], sure: bool) -> tuple[float, float]:
        """Rivals distinguished per second; of equal ones the clearer, in whole multiples of what is needed."""
        clearness = float(np.clip(self.promises(sure)[among] // self.question.needed, 0, 4).sum())
        return len(self.apart(among, sure)) / max(self.stand_time_s, 1.0), clearness

    def nearness(self, among: list[int], sure: bool) -> float:
        """How near it comes to telling any of them."""
        return float(self.promises(sure)[among].max())


def _answers(question: Asked, probes: Sequence[Probe], otherwise: str) -> Iterator[Experiment]:
    """Experiments until every rival is distinguished or nothing tells any of the rest."""
    start, left = _Offer(question=question, probes=(), rows=question.table), list(range(len(question.rivals)))
    while left:
        chosen, sure = _chosen(start, left, probes)
        apart = chosen.apart(left, sure)
        if not apart:
            yield _nothing(question, left, start, chosen, otherwise)
            return
        yield from (_experiment(question, chosen, probe, apart) for probe in dict.fromkeys(chosen.probes))
        start, left = replace(start, rows=chosen.rows), [rival for rival in left if rival not in apart]


def _chosen(start: _Offer, left: list[int], probes: Sequence[Probe]) -> tuple[_Offer, bool]:
    """The offer worth most, and whether it is sure: what few runs tell goes before what many do."""
    single = [start.further(probe) for probe in probes]
    if any(offer.apart(left, sure=True) for offer in single):
        return _best(single, left, sure=True), True
    several = _several(start, single, left)
    for sure in (True, False):
        for offers in (several, [_summed(start, several, left, sure)]):
            if any(offer.apart(left, sure) for offer in offers):
                return _best(offers, left, sure), sure
    return max(several, key=lambda offer: offer.nearness(left, sure=False)), False


def _best(offers: Sequence[_Offer], left: list[int], sure: bool) -> _Offer:
    return max(offers, key=lambda offer: offer.worth(left, sure))


def _several(start: _Offer, single: Sequence[_Offer], left: list[int]) -> list[_Offer]:
    """Single probes, then what promises most several times, or two together. Without any there is one offer, of none.

    What three runs of a probe tell is three times what one does.
    """
    promising = [offer for offer in single if offer.nearness(left, sure=True) * _RUNS >= offer.question.needed]
    mounted = [probe for offer in single for probe in offer.probes if probe.pairs]
    repeated = [offer.further(*offer.probes * (_RUNS - 1)) for offer in promising]
    return [*single, *repeated, *(start.further(*pair) for pair in combinations(mounted, 2))] or [start]


def _summed(start: _Offer, several: Sequence[_Offer], left: list[int], sure: bool) -> _Offer:
    """One run after the other of what brings most by itself, each time the best, until a rival is distinguished.

    Where even the best brings so little that so many runs would not do, it is left at that.
    """
    now = start.nearness(left, sure)
    ranked = sorted(several, key=lambda offer: (now - offer.nearness(left, sure)) / max(len(offer.probes), 1))
    offer, *others = ranked[:_TRIED]
    brings = (offer.nearness(left, sure) - now) / max(len(offer.probes), 1)
    probes = list(dict.fromkeys(probe for each in (offer, *others) for probe in each.probes))
    if now + MOST_RUNS * brings < offer.question.needed:
        return offer
    while len(offer.probes) < MOST_RUNS and not offer.apart(left, sure):
        offer = max((offer.further(probe) for probe in probes), key=lambda each: each.nearness(left, sure))
    return offer


def _experiment(question: Asked, offer: _Offer, probe: Probe, apart: list[int]) -> Experiment:
    sure = offer.apart(apart, sure=True) == apart
    choose = np.min if sure else np.max
    rivals = tuple(question.rivals[rival] for rival in apart)
    runs = Counter(each.programme for each in offer.probes)
    others = [name for name in runs if name != probe.programme]
    needed = () if sure else _needed(question, offer, apart)
    separation = float(choose(offer.expected.separations[:, apart], axis=0).min())
    return Experiment(
        separates=(question.name, *rivals),
        programme=probe.programme,
        why=qualified(promised(probe, question.name, rivals, separation), needed, others, runs[probe.programme]),
        command=probe.command,
        separation=separation,
        least=float(choose(offer.expected.promises[:, apart], axis=0).min()),
        stand_time_s=runs[probe.programme] * probe.stand_time_s,
        runs=runs[probe.programme],
        together=tuple(others),
        outlook=question.outlook(offer.rows, probe.programme, apart, sure),
    )


def _needed(question: Asked, offer: _Offer, apart: list[int]) -> list[str]:
    """Explanations one of which must be true for them to be distinguished."""
    return sorted(
        {
            question.name if offer.expected.promises[0, rival] >= question.needed else question.rivals[rival]
            for rival in apart
        }
    )


def _nothing(question: Asked, left: list[int], start: _Offer, nearest: _Offer, otherwise: str) -> Experiment:
    rivals = tuple(question.rivals[rival] for rival in left)
    separation = float(nearest.expected.separations.max(axis=0)[left].max())
    owners = {question.belongs_to(name) for name in (question.name, *rivals)}
    remedy = remedied(owners, nearest.probes, _runs_needed(question, left, start, nearest), otherwise)
    return Experiment(
        separates=(question.name, *rivals),
        programme="",
        why=no_programme(question.name, rivals, separation, remedy),
        command="",
        separation=separation,
        stand_time_s=0.0,
        remedy=remedy,
    )


def _runs_needed(question: Asked, left: list[int], start: _Offer, nearest: _Offer) -> int:
    """How often the nearest offer would have to be run; 0 where that is beyond all reason."""
    now, then = (offer.nearness(left, sure=True) for offer in (start, nearest))
    needed = (question.needed - now) / max(then - now, 1e-9)
    return int(np.ceil(needed)) if needed < _PATIENCE else 0
