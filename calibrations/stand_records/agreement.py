"""Whether two runs say the same of their stand, and what they say together."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.stand_records.corrections import Corrections, chi_square_p
from tumble.calibrations.stand_records.terms import Term, harmonic_term, head_course, union

AGREE_P = 0.01
"""Two runs contradict each other where chance makes differences as large as theirs in fewer of a hundred cases."""
CONFIRMED_P = 0.01
"""A second unit confirms a term that it sees beyond this chance, whether or not it would have found it by itself."""

SHOWN_P = 0.001
"""Of an error of the head those harmonics stay that are beyond this chance: of 35, one is none in one map of thirty."""


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """What two runs say together."""

    corrections: Corrections
    """Weighted mean; without terms where neither confirms the other."""
    each: tuple[Corrections, Corrections]
    """The same terms by each run."""
    p_value: float
    """Of differences as large by chance (chi-square on all coefficients)."""

    @property
    def holds(self) -> bool:
        """Whether both confirm something, and do not contradict each other."""
        return bool(self.corrections.terms) and self.p_value >= AGREE_P


class Run(Protocol):
    """What a run says of the stand; each method has its own."""

    @property
    def terms(self) -> tuple[Term, ...]:
        """What it found."""
        ...

    @property
    def highest_order(self) -> int:
        """Harmonics of the head that its settings can tell apart."""
        ...

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What it says of these terms, fitted together."""
        ...


@one_blas_thread
def agreement(first: Run, second: Run) -> Agreement:
    """Hold two runs against each other on all terms that one of them tells apart and the other confirms.

    Where both see an error of the head, and their settings tell harmonics apart, it becomes those that both together
    show, more than each alone.
    """
    terms = _confirmed(first, second, union(first.terms, second.terms))
    highest = min(first.highest_order, second.highest_order)
    if not (highest and any(term.orders for term in terms)):
        return _on(first, second, terms)
    course = head_course(highest)
    together = _on(first, second, union(tuple(terms), (course,)))
    told = all(course in each.terms for each in together.each)
    return _on(first, second, _shown(together.corrections, course) if told else terms)


def _on(first: Run, second: Run, terms: Sequence[Term]) -> Agreement:
    each = (first.estimate(terms), second.estimate(terms))
    corrections, p_value = updated(*each)
    return Agreement(corrections=corrections, each=each, p_value=p_value)


def _confirmed(first: Run, second: Run, terms: Sequence[Term]) -> Sequence[Term]:
    """Those of the terms that both runs see, beside each other."""
    each = (first.estimate(terms), second.estimate(terms))
    kept = [term for term in terms if all(_confirms(one, term) for one in each)]
    return kept if len(kept) == len(terms) else _confirmed(first, second, kept)


def _shown(corrections: Corrections, course: Term) -> list[Term]:
    """The terms with single harmonics in the place of the course of the head."""
    start = corrections.place(course).start
    shown = []
    for place, order in enumerate(course.orders):
        here = slice(start + 2 * place, start + 2 * place + 2)
        if chi_square_p(corrections.values[here], corrections.covariance[here, here]) < SHOWN_P:
            shown.append(harmonic_term(order))
    return [*shown, *(term for term in corrections.terms if not term.orders)]


def _confirms(estimate: Corrections, term: Term) -> bool:
    return term in estimate.terms and estimate.p_value(term) < CONFIRMED_P


def updated(known: Corrections, more: Corrections) -> tuple[Corrections, float]:
    """What is known with a further estimate of some of its terms: weighted least squares (the Kalman update).

    With it the probability that two honest estimates differ so much.
    """
    if not more.terms:
        return known, 1.0
    chosen = np.concatenate([np.arange(len(known.values))[known.place(term)] for term in more.terms])
    seen: FloatArray = np.eye(len(known.values))[chosen]
    difference = more.values - known.values[chosen]
    spread = seen @ known.covariance @ seen.T + more.covariance
    gain = np.linalg.solve(spread, seen @ known.covariance).T
    combined = Corrections(
        terms=known.terms,
        values=known.values + gain @ difference,
        covariance=_symmetric(known.covariance - gain @ seen @ known.covariance),
    )
    return combined, chi_square_p(difference, spread)


def _symmetric(matrix: FloatArray) -> FloatArray:
    return np.asarray((matrix + matrix.T) / 2.0)
