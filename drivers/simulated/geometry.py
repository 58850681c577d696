"""The simulated world's own geometry: a unit seated on a head, and gravity, as vectors and rotations.

The frame of the head turns about Z. At head angle zero its X is level and its Y points up. Directions are unit vectors;
gravity has the length 1, local g.
"""

from collections.abc import Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.messages import Message

FloatArray = NDArray[np.float64]

OX: Final = (1.0, 0.0, 0.0)
OZ: Final = (0.0, 0.0, 1.0)
DIAGONAL: Final = (1.0, 1.0, 1.0)


def rotation(axis: Sequence[float], angle_deg: float) -> FloatArray:
    """Matrix, shape (3, 3), that turns a vector about `axis` by `angle_deg`, right-handed (Rodrigues' formula)."""
    x, y, z = np.asarray(axis, dtype=np.float64) / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle_rad = np.deg2rad(angle_deg)
    turned = np.eye(3) + np.sin(angle_rad) * cross + (1.0 - np.cos(angle_rad)) * (cross @ cross)
    return np.asarray(turned)


SEATS: Final = MappingProxyType(
    {
        "face-up": rotation(OZ, 0.0),
        "face-up-90": rotation(OZ, 90.0),
        "face-down": rotation(OX, 180.0),
        "edge": rotation(OX, -90.0),
        "edge-back": rotation(OX, 90.0),
        "end": rotation(DIAGONAL, -120.0),  # Ox comes to lie along Z, Oy along X, Oz along Y
    }
)
"""How the unit is turned from face-up in each mount; the columns are its axes Ox, Oy, Oz in the frame of the head."""


def seat(mount: str) -> FloatArray:
    """Look up a mount in `SEATS`. Raises `ValueError` for one that does not exist."""
    if mount not in SEATS:
        raise ValueError(Message("there is no mount {mount!r}; known are {known}", mount=mount, known=", ".join(SEATS)))
    return SEATS[mount]


@lru_cache(maxsize=16)
def _down(axis_tilt_deg: float) -> tuple[float, float, float]:
    """Gravity in the frame of the head at angle zero."""
    x, y, z = rotation(OX, -axis_tilt_deg) @ np.array([0.0, -1.0, 0.0])
    return float(x), float(y), float(z)


def gravity(angle_deg: FloatArray, axis_tilt_deg: float) -> FloatArray:
    """Gravity in the frame of the head, shape (rows, 3), in g.

    Parameters
    ----------
    angle_deg
        True angle by which the frame has turned about the head axis, shape (rows,).
    axis_tilt_deg
        By how much the Z end of the head axis points below the horizon.
    """
    x, y, z = _down(axis_tilt_deg)
    angle_rad = np.deg2rad(angle_deg)
    sine, cosine = np.sin(angle_rad), np.cos(angle_rad)
    # The frame turns by +angle, so a fixed vector turns by -angle when seen from it.
    return np.array([cosine * x + sine * y, cosine * y - sine * x, np.full_like(sine, z)]).T


def projections(seated: FloatArray, angle_deg: FloatArray, axis_tilt_deg: float) -> FloatArray:
    """Projections (ax, ay, az) of gravity on the axes of a unit with the seat `seated`, shape (rows, 3), in g."""
    return gravity(angle_deg, axis_tilt_deg) @ seated


def ax_turning_points_deg(seated: FloatArray, from_deg: float, to_deg: float) -> FloatArray:
    """True angles strictly between two, in the order of travel, at which ax is at an extremum."""
    sine_part, cosine_part = seated[0, 0], seated[1, 0]
    first_deg = np.rad2deg(np.arctan2(sine_part, cosine_part))
    low_deg, high_deg = min(from_deg, to_deg), max(from_deg, to_deg)
    begin = np.floor((low_deg - first_deg) / 180.0) + 1
    end = np.ceil((high_deg - first_deg) / 180.0)
    points_deg: FloatArray = first_deg + 180.0 * np.arange(begin, end)
    return points_deg if from_deg <= to_deg else points_deg[::-1]
