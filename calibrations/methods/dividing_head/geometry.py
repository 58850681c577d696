"""How gravity falls on the axes of a unit that sits on the head in one of its mounts.

In the frame that turns with the head, Z lies along the head's horizontal axis and gravity, in units of local g, is
`(-sin a, -cos a, 0)` with `a = head angle + alpha0` (Avrutov, Bondar, Meleshko 2008, equation 12). Projections are
positive where a unit axis points down: minus the specific force of IEEE 1293.
"""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.messages import Message

_X, _Y, _Z = np.eye(3)

MOUNTS: Final[Mapping[str, FloatArray]] = MappingProxyType(
    {
        # Rows: the unit's axes Ox, Oy, Oz in the frame that turns with the head.
        Message.named("face-up", "face up"): np.array([_X, _Y, _Z]),
        Message.named("face-up-90", "face up, turned by 90°"): np.array([_Y, -_X, _Z]),  # +90° about Oz
        Message.named("face-down", "face down"): np.array([_X, -_Y, -_Z]),  # 180° about Ox
        Message.named("edge", "on edge"): np.array([_X, -_Z, _Y]),  # -90° about Ox, Oy against Z
        Message.named("edge-back", "on the other edge"): np.array([_X, _Z, -_Y]),  # +90° about Ox, Oy along Z
        Message.named("end", "on end"): np.array([_Z, _X, _Y]),  # Ox along Z, Oy along X
    }
)
"""Every mount by name: an orthonormal, right-handed 3 by 3 matrix."""


def gravity_in_head(angle_deg: FloatArray) -> FloatArray:
    """Gravity in the turning frame, shape (rows, 3), in g; `angle_deg` is the true angle, alpha0 included."""
    angle_rad = np.deg2rad(angle_deg)
    return np.stack([-np.sin(angle_rad), -np.cos(angle_rad), np.zeros_like(angle_rad)], axis=-1)


def projections(mounts: Sequence[str] | NDArray[np.str_], angle_deg: FloatArray) -> FloatArray:
    """Projections (ax, ay, az) of gravity on the unit's axes, shape (rows, 3), in g.

    Parameters
    ----------
    mounts
        Name of the mount of each row, a key of `MOUNTS`.
    angle_deg
        True angle of each row, alpha0 and any error of the head included, in degrees.

    Raises
    ------
    KeyError
        For a mount that does not exist.
    """
    names, which = np.unique(np.asarray(mounts, dtype=np.str_), return_inverse=True)
    rotations = np.stack([MOUNTS[str(name)] for name in names]) if len(names) else np.empty((0, 3, 3))
    return np.asarray(np.einsum("nij,nj->ni", rotations[which], gravity_in_head(np.asarray(angle_deg, float))))
