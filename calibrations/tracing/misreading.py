"""Tells misreadings from other gross errors: an angle that was read or set wrong by a round amount."""

from dataclasses import dataclass

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.joint import Joint
from calibrations.model import BASIS_SIZE, PARAMETERS, basis, coefficients
from calibrations.observations import Observations

_AGREES = 4.0
"""A row fits a misreading if what is left is below so many standard deviations of a dwell."""


def _round_amounts_deg() -> FloatArray:
    """Wrong by tens of minutes, halves of a degree, degrees, fives and tens of degrees."""
    tens_of_minutes = np.arange(1, 6) / 6.0
    halves = np.arange(2, 11) / 2.0
    degrees = np.arange(6, 11, dtype=float)
    fives = np.arange(15.0, 181.0, 5.0)
    sizes = np.concatenate([tens_of_minutes, halves, degrees, fives])
    return np.sort(np.concatenate([-sizes, sizes]))


ROUND_AMOUNTS_DEG = _round_amounts_deg()


@dataclass(frozen=True, kw_only=True)
class Misreading:
    """A row whose true angle is the reported one plus a round amount."""

    row: int
    error_deg: float


def misreadings(whole: Observations, joint: Joint) -> tuple[Misreading, ...]:
    """Which of the gross errors that `joint` has set aside are misreadings.

    `whole` is the table with these rows still in it.
    """
    aside = {entry.row for entry in joint.observations.set_aside if entry.reason.startswith("gross error")}
    rows = whole.select(np.isin(whole.row, list(aside)))
    theta = joint.fit.theta[: len(PARAMETERS)]
    found = []
    for number in range(len(rows)):
        row = rows.select(np.arange(len(rows)) == number)
        left_v = np.abs(_predictions_v(row, theta) - row.output_v[0])
        fitting = np.flatnonzero(left_v < _AGREES * joint.noise.used_v)
        if len(fitting):
            best = fitting[np.argmin(np.abs(ROUND_AMOUNTS_DEG[fitting]))]
            found.append(Misreading(row=int(row.row[0]), error_deg=float(ROUND_AMOUNTS_DEG[best])))
    return tuple(found)


def _predictions_v(row: Observations, theta: FloatArray) -> FloatArray:
    """Output of the declared model at the row's angle plus each round amount."""
    count = len(ROUND_AMOUNTS_DEG)
    tried = Observations(
        row=np.arange(count), angle_deg=row.angle_deg[0] + ROUND_AMOUNTS_DEG, mount=np.repeat(row.mounts, count)
    )
    return np.asarray(basis(tried)[:, :BASIS_SIZE] @ coefficients(theta))
