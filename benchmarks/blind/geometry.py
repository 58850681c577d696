"""Gravity on the unit's axes at every dwell (contract, observations.md, "Geometry")."""

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

_AXES: Final[Mapping[str, tuple[tuple[int, float], ...]]] = {
    "face-up": ((0, 1.0), (1, 1.0), (2, 1.0)),
    "face-up-90": ((1, 1.0), (0, -1.0), (2, 1.0)),
    "face-down": ((0, 1.0), (1, -1.0), (2, -1.0)),
    "edge": ((0, 1.0), (2, -1.0), (1, 1.0)),
    "edge-back": ((0, 1.0), (2, 1.0), (1, -1.0)),
    "end": ((2, 1.0), (0, 1.0), (1, 1.0)),
}
"""For Ox, Oy, Oz of each mount: along which axis of the head's frame it lies, and its sign."""

MOUNTS: Final = tuple(_AXES)


def projections(mounts: NDArray[np.str_], angle_deg: FloatArray, tilt_deg: FloatArray) -> FloatArray:
    """Return (ax, ay, az) in local g, positive where the axis points down, shape (rows, 3).

    Parameters
    ----------
    mounts
        Mount of each row.
    angle_deg
        True angle of the seat, alpha0 and errors of the angle included.
    tilt_deg
        Tilt of the head's axis, positive where its Z end points below the horizon.
    """
    angle, tilt = np.radians(angle_deg), np.radians(tilt_deg)
    frame = np.column_stack([-np.sin(angle) * np.cos(tilt), -np.cos(angle) * np.cos(tilt), np.sin(tilt)])
    gravity = np.empty_like(frame)
    for mount in np.unique(mounts):
        rows = mounts == mount
        for axis, (of_frame, sign) in enumerate(_AXES[str(mount)]):
            gravity[rows, axis] = sign * frame[rows, of_frame]
    return gravity
