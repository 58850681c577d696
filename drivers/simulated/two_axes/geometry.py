"""Where gravity points in a case on two axes, by turning the vector back through one frame after the other.

Ground frame: X along the level outer axis, Z up. From the ground to the case: the base leans about Y, the outer axis
turns about X, the inner axis may not be square to it (a turn about Y), it wobbles, and it turns about Z.
"""

from typing import Final

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray

RAD_PER_ARCSEC: Final = np.pi / 180.0 / 3600.0
_PLANES: Final = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


def turned_back(vectors: FloatArray, axis: str, angles_rad: FloatArray | float) -> FloatArray:
    """Vectors, shape (rows, 3), as they stand in a frame that is turned right-handed about one of its axes."""
    first, second = _PLANES[axis]
    cosine, sine = np.cos(angles_rad), np.sin(angles_rad)
    turned = vectors.copy()
    turned[:, first] = cosine * vectors[:, first] + sine * vectors[:, second]
    turned[:, second] = cosine * vectors[:, second] - sine * vectors[:, first]
    return turned


def gravity_g(
    outer_rad: FloatArray,
    inner_rad: FloatArray,
    level_y_rad: FloatArray,
    square_rad: float,
    wobble_rad: tuple[FloatArray, FloatArray],
) -> FloatArray:
    """Gravity in the case, shape (rows, 3), +1 where an axis points down.

    `outer_rad` holds the level about the outer axis; `wobble_rad` turns the inner axis about x and y of the arm.
    """
    down = np.zeros((len(outer_rad), 3))
    down[:, 2] = -1.0
    in_arm = turned_back(turned_back(turned_back(down, "y", level_y_rad), "x", outer_rad), "y", square_rad)
    wobbled = turned_back(turned_back(in_arm, "x", wobble_rad[0]), "y", wobble_rad[1])
    return turned_back(wobbled, "z", inner_rad)
