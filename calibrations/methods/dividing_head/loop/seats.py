"""Whether the unit sat where the table says: a mount that was confirmed, and not changed.

Each mounting is tried in every other mount. It is asked about where the other mount leaves so many times less that no
effect could stand in its place. Of the mount before, less is asked: that the declared model rejects the table as it
stands and accepts it with that mount, by the noise within the dwells. A unit whose cross axes are not distinguishable
from the noise gives nothing to ask.
"""

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.special import chdtrc

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed, compress
from tumble.calibrations.methods.dividing_head.best_alpha0 import quick_parameters
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.calibrations.methods.dividing_head.model import PARAMETERS, basis, coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import mountings
from tumble.messages import Message, with_wording

_REJECTED_P: Final = 1e-6
_ACCEPTED_P: Final = 1e-3
_CLEARER: Final = 20.0
"""So many times less must another mount leave."""
_CLEARLY_LESS: Final = 2.0
"""And so many times less the mount before, with which the model must then agree."""
_WORTH_A_SWAP: Final = 0.9
"""Another mount must leave less than this part of the sum of squares to be looked at further."""
_MOST_SWAPS: Final = 5
_MOST_MOUNTINGS: Final = 100
_SUSPECTS: Final = 6
"""So many mountings, those that agree least with the rest, are tried in other mounts."""
_TIED: Final = 1.05


@dataclass(frozen=True, kw_only=True)
class Seats:
    """A mount for every mounting, and what the declared model leaves with them."""

    mounts: tuple[str, ...]
    squares_v2: float
    off_v2: FloatArray
    """Mean square residual of each mounting, shape (mountings,)."""
    along_x: bool
    """Whether the input axis, x, is then the most sensitive one."""


class Mountings:
    """The mountings of a table, each compressed at most once in every mount, so that trying others costs little."""

    def __init__(self, observations: Observations) -> None:
        self.observations = observations
        self.numbers = mountings(observations)
        self.declared = tuple(str(observations.mounts[self.numbers == number][0]) for number in self.each)
        self._rows = np.bincount(self.numbers)
        self._functions = {
            mount: basis(replace(observations, mount=np.full(len(observations), mount))) for mount in MOUNTS
        }
        self._compressed: dict[tuple[int, str], Compressed] = {}

    @property
    def each(self) -> range:
        """Numbers of the mountings."""
        return range(int(self.numbers[-1]) + 1)

    def _in_mount(self, number: int, mount: str) -> Compressed:
        if (number, mount) not in self._compressed:
            rows, output_v = self.numbers == number, self.observations.output_v
            functions = self._functions[mount][rows]
            self._compressed[number, mount] = compress(functions, output_v[rows], np.ones(len(functions)))
        return self._compressed[number, mount]

    def seated(self, mounts: tuple[str, ...]) -> Seats:
        """Fit the table with these mounts."""
        parts = [self._in_mount(number, mount) for number, mount in enumerate(mounts)]
        r, z = np.concatenate([part.r for part in parts]), np.concatenate([part.z for part in parts])
        theta = quick_parameters(compress(r, z, np.ones(len(z))))
        misfit = (z - r @ coefficients(theta)).reshape(len(parts), -1)
        left_v2 = np.sum(misfit**2, axis=1) + np.array([part.rest_v2 for part in parts])
        kx, ky, kz = np.abs(theta[1:4])
        return Seats(
            mounts=mounts,
            squares_v2=float(left_v2.sum()),
            off_v2=left_v2 / self._rows,
            along_x=bool(kx > max(ky, kz)),
        )


def wrong_seat(observations: Observations) -> str:
    """Ask about mountings that look like another mount; empty where there is nothing to ask."""
    if observations.mount is None or not 1 <= mountings(observations)[-1] < _MOST_MOUNTINGS:
        return ""
    table = Mountings(observations)
    supposed = declared = table.seated(table.declared)
    noise_v2 = _noise_v2(observations)
    spare = len(observations) - len(PARAMETERS)
    if spare < 1 or not _chance(declared, noise_v2, spare) < _REJECTED_P:
        return ""
    for _ in range(_MOST_SWAPS):
        better = _best_swap(table, supposed, noise_v2, spare)
        if better.squares_v2 > _WORTH_A_SWAP * supposed.squares_v2:
            return ""
        supposed = better
        if _explains(declared, supposed, noise_v2, spare):
            return _question(table, supposed.mounts)
    return ""


def _noise_v2(observations: Observations) -> float:
    """Variance of the mean of a dwell by the scatter of its samples; 0 where the table does not say."""
    if observations.voltage_sd_v is None or observations.samples is None:
        return 0.0
    return float(np.mean(observations.voltage_sd_v**2 / np.maximum(observations.samples, 1)))


def _chance(seats: Seats, noise_v2: float, spare: int) -> float:
    """Probability of so much left by noise alone; 0 without a noise to judge by."""
    if not noise_v2 > 0.0:  # not a number, neither
        return 0.0
    return float(chdtrc(spare, seats.squares_v2 / noise_v2))


def _explains(declared: Seats, supposed: Seats, noise_v2: float, spare: int) -> bool:
    less = math.sqrt(declared.squares_v2 / max(supposed.squares_v2, 1e-300))
    unchanged = all(
        mount in (said, supposed.mounts[number - 1]) if number else mount == said
        for number, (said, mount) in enumerate(zip(declared.mounts, supposed.mounts, strict=True))
    )
    accepted = unchanged and _chance(supposed, noise_v2, spare) > _ACCEPTED_P
    return less > _CLEARER or (accepted and less > _CLEARLY_LESS)


def _best_swap(table: Mountings, supposed: Seats, noise_v2: float, spare: int) -> Seats:
    """The one mounting in another mount that leaves least.

    Of several that do, or leave no more than noise: a likely one, and not changed.
    """
    swaps: list[tuple[bool, bool, float, Seats]] = []
    for number in np.argsort(-supposed.off_v2)[:_SUSPECTS].tolist():
        before = supposed.mounts[number - 1] if number else ""
        for mount in set(MOUNTS) - {supposed.mounts[number]}:
            swapped = table.seated((*supposed.mounts[:number], mount, *supposed.mounts[number + 1 :]))
            swaps.append((not swapped.along_x, mount != before, swapped.squares_v2, swapped))
    least_v2 = min(squares_v2 for *_, squares_v2, _ in swaps)
    tied = [swap for swap in swaps if swap[2] <= _TIED * least_v2 or _chance(swap[3], noise_v2, spare) > _ACCEPTED_P]
    return min(tied, key=lambda swap: swap[:3])[3]


def _question(table: Mountings, mounts: tuple[str, ...]) -> str:
    rows: list[Message] = []
    for number, (said, fits) in enumerate(zip(table.declared, mounts, strict=True)):
        if said != fits:
            first, last = table.observations.row[table.numbers == number][[0, -1]]
            found = Message(
                "rows {first} to {last} are said to be in {said} and fit {fits}",
                first=first,
                last=last,
                said=with_wording(said),
                fits=with_wording(fits),
            )
            unmoved = number and fits == mounts[number - 1]
            rows.append(Message("{found}, where the unit sat before", found=found) if unmoved else found)
    return Message(
        "{source}: {rows}; was the unit seated as asked? Measure these rows again, or correct their mount",
        source=table.observations.source,
        rows=Message.joined("; ", rows),
    )
