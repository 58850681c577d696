"""Vibration rectification coefficients by axis and frequency band (IEEE Std 1293-2018: µg per g² r.m.s.)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.beside import fitted_beside
from tumble.calibrations.methods.vibration.fit import VibrationFit
from tumble.calibrations.methods.vibration.observations import AXES
from tumble.calibrations.methods.vibration.table import VibrationTable
from tumble.calibrations.tracing.trace import Trace

_CENTRE_HZ: Final = 1000.0
"""Octave bands are those of IEC 61260-1 with base 2, one of them about 1 kHz."""


@dataclass(frozen=True, kw_only=True)
class BandCoefficient:
    """The coefficient of one axis in one band."""

    axis: str
    low_hz: float | None
    """Both None where the vibration was random."""
    high_hz: float | None
    value: float
    """In µg/g²."""
    standard_uncertainty: float
    dwells: int

    def as_json(self) -> dict[str, Any]:
        """As results have it."""
        return {
            "axis": self.axis,
            "band_hz": None if self.low_hz is None else [self.low_hz, self.high_hz],
            "value": self.value,
            "standard_uncertainty": self.standard_uncertainty,
            "unit": "µg/g²",
            "dwells": self.dwells,
        }


def band_coefficients(table: VibrationTable, fit: VibrationFit, trace: Trace) -> tuple[BandCoefficient, ...]:
    """Coefficients K_ii, K_oo and K_pp in each octave band of sines, and under random vibration, beside what was found.

    Those of one axis are fitted together, all others over all frequencies; what an experiment does not tell is left
    out.
    """
    return tuple(each for axis in range(len(AXES)) if fit.told((axis,)) for each in _of_axis(table, fit, trace, axis))


def _of_axis(table: VibrationTable, fit: VibrationFit, trace: Trace, axis: int) -> Sequence[BandCoefficient]:
    products = table.scene.products_g2[:, axis]
    band = bands(table)
    numbers = np.unique(band[products > 0.0])
    columns = products[:, None] * (band[:, None] == numbers)
    found = fitted_beside(table, fit, trace, columns, left_out=(axis,))
    return [
        BandCoefficient(
            axis=AXES[axis],
            low_hz=None if np.isinf(number) else float(_CENTRE_HZ * 2.0 ** (number - 0.5)),
            high_hz=None if np.isinf(number) else float(_CENTRE_HZ * 2.0 ** (number + 0.5)),
            value=float(value),
            standard_uncertainty=float(uncertainty),
            dwells=int(np.count_nonzero(column)),
        )
        for number, value, uncertainty, told, column in zip(
            numbers, found.values, found.uncertainties, found.told, columns.T, strict=True
        )
        if told
    ]


def bands(table: VibrationTable) -> FloatArray:
    """Number of the octave band of each row, that about 1 kHz being 0; infinite where the vibration is random."""
    frequency_hz = np.maximum(table.scene.frequency_hz, 1e-3)
    return np.where(table.observations.random, np.inf, np.round(np.log2(frequency_hz / _CENTRE_HZ)))
