"""The second-order model of an accelerometer under vibration, and the names of its coefficients.

Averaged over whole periods the output is that at rest in the same mounting plus `Σ K_xy m_xy` with the mean products
of `products` (Chen and Dong; IEEE Std 1293-2018, vibration rectification coefficient K_ii in µg/g²). Internal
parameters are the five coefficients, then the rest output of each mounting, which is a nuisance.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.products import mean_products, static_products

NAMES: Final = ("k_ii", "k_oo", "k_pp", "k_io", "k_ip")
UNIT: Final = "µg/g²"
UNITS: Final = dict.fromkeys(NAMES, UNIT)
COEFFICIENTS: Final = len(NAMES)
SUMS: Final = ((0, 2), (0, 1), (1, 2), (0, 1, 2))
"""Of which of them a sum may be told where none is told by itself."""


def name_of(sum_of: tuple[int, ...]) -> str:
    """What a sum of coefficients is called: `k_ii+k_pp`."""
    return "+".join(NAMES[place] for place in sum_of)


def values_of(theta: FloatArray) -> dict[str, float]:
    """K_ii … K_ip, the first of `theta`, and every sum of which it may be that it alone is told, by name."""
    every = (*((place,) for place in range(COEFFICIENTS)), *SUMS)
    return {name_of(each): float(theta[list(each)].sum()) for each in every}


def rest_levels(rows: VibrationObservations) -> NDArray[np.int64]:
    """Number of the rest output of each row, from 0: one for each mounting, and pose of the input axis in it."""
    return labels(rows.mountings, np.round(rows.filled("gi_g"), 3))


def functions(rows: VibrationObservations, levels: int | None = None) -> FloatArray:
    """Functions of the declared model, shape (rows, 5 + rest outputs); with room for so many `levels` where given.

    The static products of gravity belong to the coefficients too: on a turntable that is tilted they differ between
    rest and turning.
    """
    number = rest_levels(rows)
    count = int(number.max(initial=0)) + 1 if levels is None else levels
    at_rest = (number[:, None] == np.arange(count)).astype(float)
    return np.column_stack([mean_products(rows) + static_products(rows), at_rest])
