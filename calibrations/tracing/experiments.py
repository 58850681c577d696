"""Which experiment would tell apart what a table cannot: chosen by what the rivals predict for it."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tumble.calibrations.tracing.experiment_sentences import no_programme, promised, qualified, remedied
from tumble.calibrations.tracing.offers import Asked, Confidence, Offer, chosen, distinct, runs_needed
from tumble.calibrations.tracing.places import PlaceQuestion, places
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.separation import (
    Outlook,
    Question,
)
from tumble.calibrations.tracing.table import Extensible
from tumble.calibrations.tracing.trace import Trace


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


def _answers(question: Asked, probes: Sequence[Probe], otherwise: str) -> Iterator[Experiment]:
    """Experiments until every rival is distinguished or nothing tells any of the rest."""
    start, left = Offer(question=question, probes=(), rows=question.table), list(range(len(question.rivals)))
    while left:
        best, confidence = chosen(start, left, probes)
        apart = best.apart(left, confidence)
        if not apart:
            yield _nothing(question, left, start, best, otherwise)
            return
        yield from (_experiment(question, best, confidence, probe, apart) for probe in distinct(best.probes))
        start, left = replace(start, rows=best.rows), [rival for rival in left if rival not in apart]


def _experiment(question: Asked, offer: Offer, confidence: Confidence, probe: Probe, apart: list[int]) -> Experiment:
    likely = confidence is Confidence.LIKELY
    sure = offer.apart(apart, Confidence.WHICHEVER) == apart
    choose = np.min if sure else np.max
    rivals = tuple(question.rivals[rival] for rival in apart)
    runs = Counter(each.programme for each in offer.probes)
    others = [name for name in runs if name != probe.programme]
    needed = () if sure or likely else _needed(question, offer, apart)
    separation = float(choose(offer.expected.separations[:, apart], axis=0).min())
    return Experiment(
        separates=(question.name, *rivals),
        programme=probe.programme,
        why=qualified(
            promised(probe, question.name, rivals, separation), needed, others, runs[probe.programme], likely
        ),
        command=probe.command,
        separation=separation,
        least=float(choose(offer.expected.promises[:, apart], axis=0).min()),
        stand_time_s=runs[probe.programme] * probe.stand_time_s,
        runs=runs[probe.programme],
        together=tuple(others),
        outlook=question.outlook(offer.rows, probe.programme, apart, sure),
    )


def _needed(question: Asked, offer: Offer, apart: list[int]) -> list[str]:
    """Explanations one of which must be true for them to be distinguished."""
    return sorted(
        {
            question.name if offer.expected.promises[0, rival] >= question.needed else question.rivals[rival]
            for rival in apart
        }
    )


def _nothing(question: Asked, left: list[int], start: Offer, nearest: Offer, otherwise: str) -> Experiment:
    rivals = tuple(question.rivals[rival] for rival in left)
    separation = float(nearest.expected.separations.max(axis=0)[left].max())
    owners = {question.belongs_to(name) for name in (question.name, *rivals)}
    remedy = remedied(owners, nearest.probes, runs_needed(question, left, start, nearest), otherwise)
    return Experiment(
        separates=(question.name, *rivals),
        programme="",
        why=no_programme(question.name, rivals, separation, remedy),
        command="",
        separation=separation,
        stand_time_s=0.0,
        remedy=remedy,
    )
