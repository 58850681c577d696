"""Tells misreadings from other gross errors: an angle that was read or set wrong by a round amount."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.special import bdtrc

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.joint import Joint
from tumble.calibrations.methods.dividing_head.model import BASIS_SIZE, PARAMETERS, basis, coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.weights import DISTURBED, times_usual
from tumble.messages import Message

MISREADING: Final = Message.named("misreading", "misreading")
_AGREES = 4.0
"""A row agrees with a misreading if what is left is below so many standard deviations of a dwell."""
_BEYOND_TAILS = 20.0
"""No normal noise reaches so many standard deviations; where tails are heavy, one row may."""
_TAIL, _BEYOND_TAIL = 4.0, 6.334e-5
"""Standard deviations, and the part of rows of normal noise that are further off."""
_MOST = 0.6
"""A table in which fewer of the gross errors are round amounts has heavy tails."""
_CHANCE = 1e-3
"""At which so many agreements by chance are no longer believed."""


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

    `whole` is the table with these rows still in it. Round amounts lie so close that a heavy tail of the noise meets
    one by chance: there must be a row far beyond what noise without such tails reaches, or more agreement than chance
    gives. Who reads an angle wrong disturbs no samples.
    """
    aside = {entry.row for entry in joint.observations.set_aside if entry.gross}
    rows = whole.select(np.isin(whole.row, list(aside)) & (times_usual(whole) <= DISTURBED))
    looks = [_look(rows.select(np.arange(len(rows)) == number), joint) for number in range(len(rows))]
    agreeing = [look.misreading for look in looks if look.misreading]
    most = len(agreeing) > _MOST * len(looks)
    far = any(look.misreading and look.sigmas > _BEYOND_TAILS for look in looks)
    clear = most and far and not _heavy_tails(joint)
    by_chance = (
        float(bdtrc(len(agreeing) - 1, len(looks), np.mean([look.chance for look in looks]))) if agreeing else 1.0
    )
    return tuple(agreeing) if clear or by_chance < _CHANCE else ()


def _heavy_tails(joint: Joint) -> bool:
    """Whether more of the rows in use are far off than normal noise would bring."""
    sigmas = np.abs(joint.residual_v) * np.sqrt(joint.weights) / joint.noise.used_v
    return float(bdtrc(np.count_nonzero(sigmas > _TAIL) - 1, len(sigmas), _BEYOND_TAIL)) < _CHANCE


@dataclass(frozen=True, kw_only=True)
class _Look:
    """A gross error looked at as a misreading."""

    misreading: Misreading | None
    sigmas: float
    """How far off the row is, in standard deviations of a dwell."""
    chance: float
    """That any error up to this size agrees with some round amount."""


def _look(row: Observations, joint: Joint) -> _Look:
    predicted_v = _predictions_v(row, joint.fit.theta[: len(PARAMETERS)])
    plain_v, steps_v = predicted_v[0], predicted_v[1:] - predicted_v[0]
    off_v, window_v = float(row.output_v[0] - plain_v), _AGREES * joint.noise.used_v
    fitting = np.flatnonzero(np.abs(steps_v - off_v) < window_v)
    best = float(ROUND_AMOUNTS_DEG[fitting[np.argmin(np.abs(ROUND_AMOUNTS_DEG[fitting]))]]) if len(fitting) else None
    span_v = np.linspace(-abs(off_v), abs(off_v), 401)
    near = np.min(np.abs(span_v[:, None] - steps_v), axis=1) < window_v
    return _Look(
        misreading=None if best is None else Misreading(row=int(row.row[0]), error_deg=best),
        sigmas=abs(off_v) / joint.noise.used_v,
        chance=float(np.mean(near)),
    )


def _predictions_v(row: Observations, theta: FloatArray) -> FloatArray:
    """Output of the declared model at the row's angle, then at that plus each round amount."""
    angle_deg = row.angle_deg[0] + np.concatenate([[0.0], ROUND_AMOUNTS_DEG])
    count = len(angle_deg)
    tried = Observations(row=np.arange(count), angle_deg=angle_deg, mount=np.repeat(row.mounts, count))
    return np.asarray(basis(tried)[:, :BASIS_SIZE] @ coefficients(theta))
