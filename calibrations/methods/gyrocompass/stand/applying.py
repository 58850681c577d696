"""Applies a stand record to the table of a gyro platform."""

from dataclasses import replace

import numpy as np

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.stand_records.record import StandRecord


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
