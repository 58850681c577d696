"""Which experiment with head and reference would tell apart what a table cannot."""

from collections.abc import Iterator

import numpy as np

from tumble.calibrations.blas_threads import one_blas_thread
from tumble.calibrations.joining import appended
from tumble.calibrations.reference.probes import PROBES, HeadProbe
from tumble.calibrations.reference.table import HeadTable
from tumble.calibrations.support import series
from tumble.calibrations.tracing.experiments import APART, Experiment
from tumble.calibrations.tracing.linear_loop import Explained
from tumble.calibrations.tracing.separation import Question, Rows


@one_blas_thread
def next_reference_experiments(explained: Explained[HeadTable]) -> tuple[Experiment, ...]:
    """For every effect that has rivals: the experiments that tell it from them, in the least time."""
    table = explained.table
    questions = [Question(table, explained.trace, name, rivals) for name, rivals in explained.close.items() if rivals]
    return tuple(experiment for question in questions for experiment in _answers(question, table))


def _answers(question: Question, table: HeadTable) -> Iterator[Experiment]:
    """Experiments until every rival is told apart or nothing tells any of the rest."""
    left = list(range(len(question.rivals)))
    offers = [(probe, _separations(question, probe)) for probe in PROBES]
    while left:
        told = [(probe, [rival for rival in left if apart[rival] >= APART]) for probe, apart in offers]
        probe, rivals = max(told, key=lambda offer: len(offer[1]) / offer[0].stand_time_s(table.observations))
        if not rivals:
            yield _nothing(question, left, max(float(apart[left].max()) for _, apart in offers))
            return
        apart = next(apart for offered, apart in offers if offered is probe)
        yield _experiment(question, table, probe, rivals, float(apart[rivals].min()))
        left = [rival for rival in left if rival not in rivals]


def _separations(question: Question, probe: HeadProbe) -> np.ndarray:
    """Expected difference in -2 ln L from each rival whichever is true, the table and the probe fitted together."""
    before = question.table
    joined = appended(before.observations, probe.rows(before.observations))
    added = len(joined) - len(before.weights)
    rows = Rows(
        observations=joined,
        weights=np.concatenate([before.weights, np.ones(added)]),
        programmes=np.concatenate([before.programmes, np.full(added, probe.name)]),
    )
    return np.asarray(question.separations(rows).min(axis=0))


def _experiment(
    question: Question, table: HeadTable, probe: HeadProbe, rivals: list[int], separation: float
) -> Experiment:
    names = tuple(question.rivals[rival] for rival in rivals)
    return Experiment(
        separates=(question.name, *names),
        programme=probe.name,
        why=(
            f"measure {probe.does}; {question.name} then differs from {series(names)} by "
            f"{'at least ' * (len(names) > 1)}{separation:.0f} in -2 ln L"
        ),
        command="",
        separation=separation,
        stand_time_s=probe.stand_time_s(table.observations),
    )


def _nothing(question: Question, left: list[int], most: float) -> Experiment:
    names = tuple(question.rivals[rival] for rival in left)
    return Experiment(
        separates=(question.name, *names),
        programme="",
        why=(
            f"no motion of the head against this reference tells {question.name} from {series(names, 'or')}: they "
            f"differ by {most:.1f} in -2 ln L at most; use another reference"
        ),
        command="",
        separation=most,
        stand_time_s=0.0,
    )
