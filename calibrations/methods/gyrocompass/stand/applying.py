"""Applies a stand record to the table of a gyro platform, and says where a later run contradicts it."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.stand.evidence import GyrocompassRun
from tumble.calibrations.stand_records.agreement import AGREE_P
from tumble.calibrations.stand_records.corrections import Corrections, chi_square_p
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message


@one_blas_thread
def corrected(rows: GyrocompassObservations, record: StandRecord) -> GyrocompassObservations:
    """The table with true angles in place of those that the pickoff told."""
    head_map = record.corrections.head_map
    if head_map is None:
        return rows
    direction = np.zeros(len(rows), dtype=np.int64) if rows.direction is None else rows.direction
    return replace(rows, azimuth_deg=rows.azimuth_deg + head_map.error_deg(rows.azimuth_deg, direction))


def left_deg(rows: GyrocompassObservations, record: StandRecord) -> float:
    """Standard uncertainty of a corrected angle by what the record does not know of itself, r.m.s. over the rows."""
    head_map = record.corrections.head_map
    if head_map is None:
        return 0.0
    return float(np.sqrt(np.mean(head_map.standard_uncertainty_deg(rows.azimuth_deg) ** 2)))


def contradictions(run: GyrocompassRun, record: StandRecord) -> Iterator[str]:
    """What the loop, closed on rows that the record corrected, still finds of the turntable: a sentence for each error.

    What is no more than the record does not know of itself contradicts nothing.
    """
    left = run.estimate(run.terms)
    name = Message("stand record {version}", version=record.version)
    remedy = Message("derive it anew with tumble stand learn")
    for term in left.terms:
        here = left.place(term)
        if term not in record.corrections.terms:
            yield Message(
                "this run shows {found}, which {record} does not have; {remedy}",
                found=left.text(term),
                record=name,
                remedy=remedy,
            )
            continue
        there = record.corrections.place(term)
        spread = left.covariance[here, here] + record.corrections.covariance[there, there]
        if chi_square_p(left.values[here], spread) < AGREE_P:
            values = left.values.copy()
            values[here] += record.corrections.values[there]
            found = Corrections(terms=left.terms, values=values, covariance=left.covariance)
            yield Message(
                "{record} says {known}, this run says {found}; {remedy}",
                record=name,
                known=record.corrections.text(term),
                found=found.text(term),
                remedy=remedy,
            )
