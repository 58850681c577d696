"""Every heading that the rates allow: two positions leave two, and so may three that stand too close."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.geometry import wrapped_deg
from tumble.calibrations.methods.gyrocompass.model import HEADING, beside, best_angle
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.calibrations.methods.gyrocompass.weights import rate_variance

_ALIKE: Final = 9.0
"""Two headings whose -2 ln L differ by less are both possible, as in `penalties.NEAR`."""
_LEAST_DEG_H: Final = 1e-6
"""No rate is known better than this."""
_CIRCLE: Final = np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False)


def possible_headings_deg(table: GyrocompassTable, dwell_deg_h: float) -> tuple[float, ...]:
    """α0 at every minimum of the misfit that is not clearly worse than the best, in degrees, the best first.

    `dwell_deg_h` is the standard deviation of a rate of weight 1.
    """
    rates, root = table.rates, np.sqrt(table.weights)
    functions = table.declared[rates] * root[rates, None]
    output = table.observations.rate_deg_h * root[rates]
    f, z = beside(functions[:, HEADING : HEADING + 1], functions[:, :HEADING], output)
    misfit = _misfits(f, z, _CIRCLE)
    lowest = np.flatnonzero((misfit < np.roll(misfit, 1)) & (misfit <= np.roll(misfit, -1)))
    found_rad = np.array([best_angle(f, z, float(_CIRCLE[place])) for place in lowest])
    depth = _misfits(f, z, found_rad)
    ruler = max(dwell_deg_h, np.sqrt(rate_variance(table.observations) or 0.0), _LEAST_DEG_H)
    near = [place for place in np.argsort(depth) if depth[place] - depth.min() < _ALIKE * ruler**2]
    return tuple(dict.fromkeys(round(wrapped_deg(float(np.rad2deg(found_rad[place]))), 9) for place in near))


def _misfits(f: FloatArray, z: FloatArray, angles_rad: FloatArray) -> FloatArray:
    return np.asarray(np.sum((z[:, None] - f @ np.stack([np.sin(angles_rad), np.cos(angles_rad)])) ** 2, axis=0))
