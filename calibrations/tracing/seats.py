"""Whether the unit sat where the table says: a mount that was confirmed, and not changed.

Each mounting is tried in every other mount. It is asked about where the declared model rejects the table as it stands
and accepts it with the other mount, by the noise within the dwells; or where the other mount leaves so many times less
that no effect could stand in its place. A unit whose cross axes cannot be told from the noise gives nothing to ask.
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtrc

from calibrations.compression import compress
from calibrations.fit import joint_fit
from calibrations.geometry import MOUNTS
from calibrations.model import basis
from calibrations.observations import Observations
from calibrations.repeats import mountings

_REJECTED_P: Final = 1e-6
_ACCEPTED_P: Final = 1e-3
_CLEARER: Final = 20.0
"""Without a noise to judge by, what is left must become so many times less."""
_WORTH_A_SWAP: Final = 0.9
"""Another mount must leave less than this part of the sum of squares to be looked at further."""
_MOST_SWAPS: Final = 5
_MOST_MOUNTINGS: Final = 100
_TIED: Final = 1.05

Numbers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Seats:
    """A table with mounts, and what the declared model leaves of it."""

    mounts: NDArray[np.str_]
    """Of every row."""
    squares_v2: float
    freedom: int
    along_x: bool
    """Whether the input axis, x, is then the most sensitive one."""


def wrong_seat(observations: Observations) -> str:
    """Ask about mountings that look like another mount; empty where there is nothing to ask."""
    numbers = mountings(observations)
    if observations.mount is None or not 1 < numbers[-1] + 1 <= _MOST_MOUNTINGS:
        return ""
    declared = _seats(observations, observations.mount)
    noise_v2 = _noise_v2(observations)
    if declared.freedom < 1 or not _chance(declared, noise_v2) < _REJECTED_P:
        return ""
    supposed = declared
    for _ in range(_MOST_SWAPS):
        better = _best_swap(observations, numbers, supposed)
        if better.squares_v2 > _WORTH_A_SWAP * supposed.squares_v2:
            return ""
        supposed = better
        if _explains(declared, supposed, noise_v2):
            return _question(observations, numbers, supposed.mounts)
    return ""


def _seats(observations: Observations, mounts: NDArray[np.str_]) -> Seats:
    functions = basis(replace(observations, mount=mounts))
    fit = joint_fit(compress(functions, observations.output_v, np.ones(len(observations))))
    kx, ky, kz = np.abs(fit.theta[1:4])
    return Seats(
        mounts=mounts,
        squares_v2=fit.squares_v2,
        freedom=len(observations) - fit.fitted,
        along_x=bool(kx > max(ky, kz)),
    )


def _noise_v2(observations: Observations) -> float:
    """Variance of the mean of a dwell by the scatter of its samples; 0 where the table does not say."""
    if observations.voltage_sd_v is None or observations.samples is None:
        return 0.0
    return float(np.mean(observations.voltage_sd_v**2 / np.maximum(observations.samples, 1)))


def _chance(seats: Seats, noise_v2: float) -> float:
    """Probability of so much left by noise alone; 0 without a noise to judge by."""
    if not noise_v2 > 0.0:  # not a number, neither
        return 0.0
    return float(chdtrc(max(seats.freedom, 1), seats.squares_v2 / noise_v2))


def _explains(declared: Seats, supposed: Seats, noise_v2: float) -> bool:
    clearer = declared.squares_v2 > _CLEARER**2 * supposed.squares_v2
    return clearer or _chance(supposed, noise_v2) > _ACCEPTED_P


def _best_swap(observations: Observations, numbers: Numbers, supposed: Seats) -> Seats:
    """The one mounting in another mount that leaves least; of several that do, a likely one, and not changed."""
    swaps: list[tuple[bool, bool, float, Seats]] = []
    for number in range(int(numbers[-1]) + 1):
        inside = numbers == number
        before = supposed.mounts[numbers == number - 1][0] if number else ""
        for mount in MOUNTS:
            if mount != supposed.mounts[inside][0]:
                swapped = _seats(observations, np.where(inside, mount, supposed.mounts))
                swaps.append((not swapped.along_x, mount != before, swapped.squares_v2, swapped))
    least_v2 = min(squares_v2 for *_, squares_v2, _ in swaps)
    tied = [swap for swap in swaps if swap[2] <= _TIED * least_v2]
    return min(tied, key=lambda swap: swap[:3])[3]


def _question(observations: Observations, numbers: Numbers, mounts: NDArray[np.str_]) -> str:
    said = observations.mounts
    rows = []
    for number in np.unique(numbers[mounts != said]).tolist():
        inside = numbers == number
        first, last = observations.row[inside][[0, -1]]
        kept = number and mounts[inside][0] == mounts[numbers == number - 1][0]
        before = ", where the unit sat before" if kept else ""
        rows.append(f"rows {first} to {last} are said to be in {said[inside][0]} and fit {mounts[inside][0]}{before}")
    return (
        f"{observations.source}: {'; '.join(rows)}; was the unit seated as asked? Measure these rows again, or correct "
        "their mount"
    )
