"""Which experiment would tell apart what a table cannot: chosen by what the rivals predict for it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.experiment_sentences import no_programme, promised, qualified
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.separation import Difference, Outlook, PlannedRows, Question
from tumble.calibrations.tracing.table import Extensible
from tumble.calibrations.tracing.trace import Trace

APART = 16.0
"""Explanations that differ by this in -2 ln L are distinguished: four standard deviations."""
_RUNS = 3
"""How often a probe is run where once is not enough."""


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
    runs: int = 1
    """How often it is to be run; the stand time is that of all of them."""
    together: tuple[str, ...] = ()
    """Programmes without which it tells nothing apart."""
    outlook: Outlook | None = None
    """What it would show; None where no programme would help."""


def next_experiments(
    base: Extensible, trace: Trace, close: Mapping[str, Sequence[Rival]], probes: Sequence[Probe], otherwise: str = ""
) -> tuple[Experiment, ...]:
    """For every effect that has rivals: the experiments that tell it from them, in the least time.

    `close` holds the rivals of each effect of the trace by name, `probes` what can be run. Where none of them helps,
    the experiment says so, with what to do `otherwise`, and has no command.
    """
    questions = [Question(base, trace, name, rivals) for name, rivals in close.items() if rivals]
    return tuple(experiment for question in questions for experiment in _answers(question, probes, otherwise))


@dataclass(frozen=True, kw_only=True)
class _Offer:
    """One or two probes, run one after the other, and what they would tell."""

    probes: tuple[Probe, ...]
    runs: int
    rows: PlannedRows
    each_way: FloatArray
    """Separation from each rival, if the effect is true and if the rival is, shape (2, rivals)."""

    @property
    def stand_time_s(self) -> float:
        return self.runs * sum(probe.stand_time_s for probe in self.probes)

    def separations(self, sure: bool) -> FloatArray:
        """Separation from each rival: sure whichever is true, or if one of the two is."""
        return np.asarray(self.each_way.min(axis=0) if sure else self.each_way.max(axis=0))

    def apart(self, among: list[int], sure: bool) -> list[int]:
        """Rivals that it tells apart."""
        separations = self.separations(sure)
        return [rival for rival in among if separations[rival] >= APART]

    def worth(self, among: list[int], sure: bool) -> tuple[float, float]:
        """Rivals distinguished per second; of equal ones the clearer, in whole multiples of what is needed."""
        clearness = float(np.minimum(self.separations(sure)[among] // APART, 4).sum())
        return len(self.apart(among, sure)) / max(self.stand_time_s, 1.0), clearness


def _answers(question: Question, probes: Sequence[Probe], otherwise: str) -> Iterator[Experiment]:
    """Experiments until every rival is distinguished or nothing tells any of the rest."""
    rows, left = question.table, list(range(len(question.rivals)))
    while left:
        offers = _offers(question, rows, left, probes)
        chosen, apart = _best(offers, left, sure=True)
        if not apart:
            chosen, apart = _best(offers, left, sure=False)
        if not apart:
            yield _nothing(question, left, chosen, otherwise)
            return
        yield from (_experiment(question, chosen, probe, apart) for probe in chosen.probes)
        rows, left = chosen.rows, [rival for rival in left if rival not in apart]


def _best(offers: Sequence[_Offer], left: list[int], sure: bool) -> tuple[_Offer, list[int]]:
    """The offer worth most, and the rivals that it tells apart."""
    best = max(offers, key=lambda offer: offer.worth(left, sure))
    return best, best.apart(left, sure)


def _offers(question: Question, rows: PlannedRows, left: list[int], probes: Sequence[Probe]) -> list[_Offer]:
    """Single probes, then more of them: several times, or two together, where no single one is sure to tell anything.

    Without any probe there is one offer, of nothing.
    """
    offers = [_offer(question, rows, (probe,)) for probe in probes]
    if not any(offer.apart(left, sure=True) for offer in offers):
        others = [probe for probe in probes if probe.pairs]
        promising = [offer for offer in offers if offer.separations(sure=True)[left].max() * _RUNS >= APART]
        offers += [_offer(question, rows, offer.probes, _RUNS) for offer in promising]
        offers += [_offer(question, rows, pair) for pair in combinations(others, 2)]
    return offers or [_offer(question, rows, ())]


def _offer(question: Question, rows: PlannedRows, probes: tuple[Probe, ...], runs: int = 1) -> _Offer:
    for probe in probes * runs:
        rows = rows.followed_by(probe)
    return _Offer(probes=probes, runs=runs, rows=rows, each_way=question.separations(rows))


def _experiment(question: Question, offer: _Offer, probe: Probe, apart: list[int]) -> Experiment:
    separations = offer.separations(sure=False)[apart]
    sure = bool((offer.separations(sure=True)[apart] >= APART).all())
    separation = float((offer.separations(sure=True)[apart] if sure else separations).min())
    rivals = tuple(question.rivals[rival] for rival in apart)
    others = [other.programme for other in offer.probes if other is not probe]
    needed = () if sure else _needed(question, offer, apart)
    return Experiment(
        separates=(question.name, *rivals),
        programme=probe.programme,
        why=qualified(promised(probe, question.name, rivals, separation), needed, others, offer.runs),
        command=probe.command,
        separation=separation,
        stand_time_s=offer.runs * probe.stand_time_s,
        runs=offer.runs,
        together=tuple(others),
        outlook=_outlook(question, offer, probe, apart, sure),
    )


def _outlook(question: Question, offer: _Offer, probe: Probe, apart: list[int], sure: bool) -> Outlook:
    """What the probe would show of each rival: where the two are closer if that is enough, else where they are not."""
    left_v = question.left(offer.rows) * question.dwell_v
    each_way = offer.each_way[:, apart]
    ways = each_way.argmin(axis=0) if sure else each_way.argmax(axis=0)
    pairs = [(question.name, question.rivals[rival]) for rival in apart]
    return Outlook(
        rows=offer.rows.rows,
        probed=offer.rows.programmes == probe.programme,
        dwell_v=question.dwell_v,
        differences=tuple(
            Difference(true=pair[way], other=pair[1 - way], left_v=left_v[way, :, rival])
            for pair, way, rival in zip(pairs, ways.tolist(), apart, strict=True)
        ),
    )


def _needed(question: Question, offer: _Offer, apart: list[int]) -> list[str]:
    """Explanations one of which must be true for them to be distinguished."""
    return sorted({question.name if offer.each_way[0, rival] >= APART else question.rivals[rival] for rival in apart})


def _nothing(question: Question, left: list[int], nearest: _Offer, otherwise: str) -> Experiment:
    rivals = tuple(question.rivals[rival] for rival in left)
    separation = float(nearest.separations(sure=False)[left].max())
    owners = {question.belongs_to(name) for name in (question.name, *rivals)}
    return Experiment(
        separates=(question.name, *rivals),
        programme="",
        why=no_programme(question.name, rivals, separation, owners, otherwise),
        command="",
        separation=separation,
        stand_time_s=0.0,
    )
