"""Applies a stand record to the table of a triad, and says where a later run contradicts it."""

from collections.abc import Iterator
from dataclasses import replace

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.stand.columns import correction_v
from tumble.calibrations.methods.triad.stand.evidence import TriadRun
from tumble.calibrations.methods.triad.table import triad_table
from tumble.calibrations.stand_records.agreement import AGREE_P
from tumble.calibrations.stand_records.corrections import Corrections, chi_square_p
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message


@one_blas_thread
def corrected(rows: TriadObservations, record: StandRecord) -> TriadObservations:
    """Outputs as they would be on a stand without these errors.

    How much an error of an angle adds is taken from a fit of the rows, then once more from one of the corrected rows.
    """
    nearly = _less(rows, correction_v(record.corrections, triad_table(rows).scene))
    return _less(rows, correction_v(record.corrections, triad_table(nearly).scene))


def _less(rows: TriadObservations, added_v: FloatArray) -> TriadObservations:
    x_v, y_v, z_v = (rows.outputs_v - added_v).T
    return replace(rows, u_x_v=x_v, u_y_v=y_v, u_z_v=z_v)


def contradictions(run: TriadRun, record: StandRecord) -> Iterator[str]:
    """What the loop, closed on rows that the record corrected, still finds of the stand: a sentence for each effect.

    What is no more than the record does not know of itself contradicts nothing.
    """
    left = run.estimate(run.terms)
    name = Message("stand record {version}", version=record.version)
    remedy = Message("derive it anew with tumble stand learn")
    for term in left.terms:
        here = left.place(term)
        known = next((each for each in record.corrections.terms if each.effect == term.effect), None)
        if known is None:
            yield Message(
                "this run shows {found}, which {record} does not have; {remedy}",
                found=left.text(term),
                record=name,
                remedy=remedy,
            )
            continue
        there = record.corrections.place(known)
        spread = left.covariance[here, here] + record.corrections.covariance[there, there]
        if chi_square_p(left.values[here], spread) < AGREE_P:
            values = left.values.copy()
            values[here] += record.corrections.values[there]
            found = Corrections(terms=left.terms, values=values, covariance=left.covariance)
            yield Message(
                "{record} says {known}, this run says {found}; {remedy}",
                record=name,
                known=record.corrections.text(known),
                found=found.text(term),
                remedy=remedy,
            )
