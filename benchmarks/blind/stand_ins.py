"""Which single catalogue effect does as well as structure without a name: an answer that the data do not contradict."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from benchmarks.blind.geometry import FloatArray, IntArray
from benchmarks.blind.named import stated
from benchmarks.blind.right import PARTED_UNITS
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import beside, declared, signal_v, slope_v_deg, whitened
from benchmarks.blind.world import Unit, respond_v

_ORDERS: Final = range(3, 37)
_PERIODS_V: Final = np.geomspace(0.08, 2.0, 60)
_THRESHOLDS: Final = np.linspace(0.05, 0.95, 19)
_TIMES: Final = np.geomspace(0.01, 1.0, 20)


def stand_ins(effect_v: FloatArray, run: Run, unit: Unit) -> frozenset[str]:
    """Return the catalogue effects that leave less than 4.8 noise units of an effect (result.md).

    Those with a shape to be searched; effects linear in their coefficients are those of `beyond_catalogue_units`.
    """
    effect, model = whitened(effect_v, run), whitened(declared(run, unit), run)
    return frozenset(
        name
        for name, columns in _candidates(run, unit)
        if np.linalg.norm(beside(effect, np.column_stack([model, whitened(columns, run)]))) < PARTED_UNITS
    )


def _candidates(run: Run, unit: Unit) -> Iterator[tuple[str, FloatArray]]:
    """Columns of each effect, for each value of what is searched."""
    slope, readings_v = slope_v_deg(run, unit), respond_v(run, unit)
    for order in _ORDERS:
        yield "graduation", slope[:, None] * _wave(np.radians(order * run.angle_deg))
    for period_v in _PERIODS_V:
        yield "daq_nonlinearity", _wave(2.0 * np.pi * readings_v / period_v)
    for threshold_v in np.quantile(readings_v, _THRESHOLDS):
        yield "range_step", (readings_v > threshold_v)[:, None].astype(np.float64)
    for tau_s in run.span_s * _TIMES:
        yield "warm_up", np.exp(-run.time_s / tau_s)[:, None]
    yield "seating", _levels(run.seating) * slope[:, None]
    yield "realisation_bias", _levels(run.realisation)
    settling = stated("settling", {"settling": 1e-3})
    yield "settling", signal_v(run, unit, [settling] if settling else [])[:, None]


def _wave(phase: FloatArray) -> FloatArray:
    return np.column_stack([np.sin(phase), np.cos(phase)])


def _levels(group: IntArray) -> FloatArray:
    return np.asarray(group[:, None] == np.unique(group), dtype=np.float64)
