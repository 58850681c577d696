"""Where a run contradicts the stand record by which it was corrected."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tumble.calibrations.stand_records.agreement import AGREE_P, Run
from tumble.calibrations.stand_records.corrections import Corrections, chi_square_p
from tumble.calibrations.stand_records.record import StandRecord
from tumble.calibrations.stand_records.terms import HEAD_COURSE, Term
from tumble.messages import Message


def contradictions(run: Run, record: StandRecord) -> Iterator[str]:
    """What the loop, closed on rows that the record corrected, still finds of the stand: a sentence for each effect.

    What is no more than the record does not know of itself contradicts nothing.
    """
    left = run.estimate(run.terms)
    name = Message("stand record {version}", version=record.version)
    remedy = Message("derive it anew with tumble stand learn")
    for term in left.terms:
        here = left.place(term)
        known = _in(record.corrections, term)
        if known is None:
            yield Message(
                "this run shows {found}, which {record} does not have; {remedy}",
                found=left.text(term),
                record=name,
                remedy=remedy,
            )
        elif chi_square_p(left.values[here], left.covariance[here, here] + known.covariance) < AGREE_P:
            values = left.values.copy()
            values[here] += known.values
            yield Message(
                "{record} says {known}, this run says {found}; {remedy}",
                record=name,
                known=known.text(term),
                found=replace(left, values=values).text(term),
                remedy=remedy,
            )


def _in(corrections: Corrections, term: Term) -> Corrections | None:
    """The corrections that hold a term under its own name; None where none do."""
    for known in corrections.terms:
        if known.effect == term.effect and known.orders == term.orders and known.size == term.size:
            here = corrections.place(known)
            return Corrections(
                terms=(term,), values=corrections.values[here], covariance=corrections.covariance[here, here]
            )
        if known.effect == HEAD_COURSE and term.orders and set(term.orders) <= set(known.orders):
            start = corrections.place(known).start
            chosen = np.concatenate([start + 2 * known.orders.index(n) + np.arange(2) for n in term.orders])
            return Corrections(
                terms=(term,),
                values=corrections.values[chosen],
                covariance=corrections.covariance[np.ix_(chosen, chosen)],
            )
    return None
