"""Applies a stand record to a later run, and says where that run contradicts it."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import scene_of
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.stand.columns import corrections_voltage_v
from tumble.calibrations.methods.dividing_head.stand.evidence import Run
from tumble.calibrations.stand_records.agreement import AGREE_P
from tumble.calibrations.stand_records.corrections import Corrections, chi_square_p
from tumble.calibrations.stand_records.record import StandRecord
from tumble.calibrations.stand_records.terms import HEAD_COURSE, Term
from tumble.messages import Message


@one_blas_thread
def corrected(observations: Observations, record: StandRecord) -> Observations:
    """Rows as they would be on a stand without these errors.

    Angles gain the error of the head, by the direction of each move; the angle as reported stays beside it. Voltages
    lose what the tilt of the axis and the voltmeter add; how much a tilt adds is taken from a fit of the rows.

    Raises
    ------
    ValueError
        No voltage, or no usable row.
    """
    corrections, head_map = record.corrections, record.corrections.head_map
    if head_map is not None:
        error_deg = head_map.error_deg(observations.angle_deg, _seen(observations).direction)
        observations = replace(observations, correction_deg=error_deg)
    if all(term.of_angle for term in corrections.terms):
        return observations
    nearly = replace(
        observations, voltage_v=observations.output_v - corrections_voltage_v(corrections, _seen(observations))
    )
    return replace(observations, voltage_v=observations.output_v - corrections_voltage_v(corrections, _seen(nearly)))


def _seen(observations: Observations) -> Scene:
    return scene_of(observations, fit_jointly(observations).fit.theta)


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
