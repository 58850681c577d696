"""Applies a stand record to the table of a triad."""

from dataclasses import replace

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.stand.columns import correction_v
from tumble.calibrations.methods.triad.table import triad_table
from tumble.calibrations.stand_records.record import StandRecord


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
