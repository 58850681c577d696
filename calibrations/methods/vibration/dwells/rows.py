"""Reduced dwells as rows of the table that is fitted and traced."""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.dwells.reduction import ReducedDwell, Reduction
from tumble.calibrations.methods.vibration.observations import SHAKER, VibrationObservations

_GAP_S: Final = 15.0
"""Between dwells whose times all begin at zero."""


def rows_of(reduction: Reduction, mounting: int = 1) -> VibrationObservations:
    """One row for each dwell that has a mean, in a shaker along the input axis.

    Mean products stand beside the sines, since they take harmonics and what else was there with them; amplitude,
    frequency and phase are those of the fundamental. What samples do not say (gravity, directions) is to be added.
    """
    dwells = [each for each in reduction.dwells if each.mean.value_ug is not None]
    count = len(dwells)

    def column(value: Callable[[ReducedDwell], float | None]) -> FloatArray:
        return np.array([np.nan if (each := value(dwell)) is None else each for dwell in dwells], dtype=float)

    square = column(lambda dwell: dwell.products.ii_g2)
    amplitude = column(lambda dwell: dwell.amplitude_g)
    columns: dict[str, Any] = {
        "time_s": _times_s(dwells),
        "apparatus": np.full(count, SHAKER),
        "mounting": np.full(count, mounting, dtype=np.int64),
        "drive_i": np.ones(count),
        "drive_o": np.zeros(count),
        "drive_p": np.zeros(count),
        "level_g": np.where(np.isfinite(amplitude), amplitude, np.sqrt(np.maximum(square, 0.0))),
        "ai_g": np.nan_to_num(amplitude),
        "ao_g": np.nan_to_num(column(lambda dwell: dwell.amplitude_o_g)),
        "fi_hz": np.nan_to_num(column(lambda dwell: dwell.frequency_hz)),
        "fo_hz": np.nan_to_num(column(lambda dwell: dwell.frequency_hz)),
        "phase_o_deg": np.nan_to_num(column(lambda dwell: dwell.phase_o_deg)),
        "phase_i_deg": np.nan_to_num(column(lambda dwell: dwell.phase_i_deg)),
        "dwell_s": column(lambda dwell: dwell.samples.duration_s),
        "output_ug": column(lambda dwell: dwell.mean.value_ug),
        "output_u_ug": column(lambda dwell: dwell.mean.standard_uncertainty_ug),
    }
    if np.isfinite(square).all():
        columns |= {
            "mii_g2": square,
            "moo_g2": np.nan_to_num(column(lambda dwell: dwell.products.oo_g2)),
            "mpp_g2": np.zeros(count),
            "mio_g2": np.nan_to_num(column(lambda dwell: dwell.products.io_g2)),
            "mip_g2": np.zeros(count),
        }
    return VibrationObservations(
        row=np.arange(1, count + 1), source=reduction.source, warnings=reduction.warnings, **columns
    )


def _times_s(dwells: list[ReducedDwell]) -> FloatArray:
    """Middle of each dwell; one after the other where the times of each begin anew."""
    middle = np.array([each.samples.middle_s for each in dwells])
    if np.all(np.diff(middle) > 0):
        return middle
    long_s = np.array([each.samples.duration_s for each in dwells])
    return np.asarray(np.cumsum(long_s + _GAP_S) - _GAP_S - long_s / 2.0)
