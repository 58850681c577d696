"""How gravity falls on a unit that is turned by hand on the head: the bank's own geometry.

A mount is written as the turn from face-up that the operator makes, and the matrices follow from it. Nothing here comes
from the analysis that the bank is used to judge.
"""

from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def _turned(about: int, angle_deg: float) -> FloatArray:
    """Rows: the unit's axes in the frame of the head after a right-handed turn about its own axis `about`."""
    cos, sin = np.cos(np.deg2rad(angle_deg)), np.sin(np.deg2rad(angle_deg))
    first, second = (about + 1) % 3, (about + 2) % 3
    axes = np.eye(3)
    axes[first, first], axes[first, second] = cos, sin
    axes[second, first], axes[second, second] = -sin, cos
    return np.round(axes, 12)


AXES: Final = MappingProxyType(
    {
        "face-up": np.eye(3),
        "face-up-90": _turned(2, 90.0),
        "face-down": _turned(0, 180.0),
        "edge": _turned(0, -90.0),
        "edge-back": _turned(0, 90.0),
        "end": np.roll(np.eye(3), 1, axis=0),  # Ox along Z, Oy along X, Oz along Y
    }
)
"""The unit's axes as rows in the frame that turns with the head, whose Z is the head's axis."""


def projections(axes: FloatArray, angle_deg: FloatArray, tilt_deg: FloatArray | float = 0.0) -> FloatArray:
    """Gravity on the unit's axes in g, positive downwards.

    Parameters
    ----------
    axes
        Axes of the unit in each row, shape (rows, 3, 3).
    angle_deg
        True angle of each row, seat and errors of the head included.
    tilt_deg
        Tilt of the head's axis; positive where its Z end points below the horizon.
    """
    angle = np.deg2rad(angle_deg)
    tilt = np.deg2rad(tilt_deg)
    level = np.cos(tilt)
    falling = np.empty((len(angle), 3))
    falling[:, 0] = -level * np.sin(angle)
    falling[:, 1] = -level * np.cos(angle)
    falling[:, 2] = np.sin(tilt)
    return np.asarray(np.einsum("nij,nj->ni", axes, falling))
