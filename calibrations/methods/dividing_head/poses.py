"""Which rows of an accelerometer's table share a pose, a setting or a mounting."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.repeats import SAME_ANGLE_DEG, labels, settings
from tumble.calibrations.methods.dividing_head.observations import Observations


def pose_groups(observations: Observations) -> NDArray[np.int64]:
    """Number of the pose of each row: same procedure, mount, head setting and direction of approach."""
    columns: list[NDArray[np.generic]] = [observations.mounts, settings(observations.angle_deg)]
    if observations.procedure is not None:
        columns.append(observations.procedure)
    if observations.direction is not None:
        columns.append(observations.direction)
    return labels(*columns)


def distinct_settings(observations: Observations) -> NDArray[np.int64]:
    """Number of the setting of each row: same mount, and same head angle modulo a turn."""
    turned_deg = observations.true_angle_deg % 360.0
    angle = settings(turned_deg)
    if angle.max(initial=0) and turned_deg.max() - turned_deg.min() > 360.0 - SAME_ANGLE_DEG:
        angle = np.where(angle == angle[np.argmax(turned_deg)], angle[np.argmin(turned_deg)], angle)
    return labels(observations.mounts, angle)


def mountings(observations: Observations) -> NDArray[np.int64]:
    """Number of the mounting of each row, from 0: an unbroken sequence of rows with one mount, in one run."""
    mounts, runs = observations.mounts, observations.runs
    seated = (mounts[1:] != mounts[:-1]) | (runs[1:] != runs[:-1])
    return np.concatenate([[0], np.cumsum(seated)])[: len(mounts)].astype(np.int64)
