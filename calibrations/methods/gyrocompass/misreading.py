"""Tells wrong angles from other gross errors: a round amount that explains the rate, and the tilt where that tells."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.readmitted import deviations
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.calibrations.tracing.findings import EffectFound
from tumble.messages import Message

MISREADING: Final = Message.named("misreading", "misreading")
_P_VALUE: Final = 2e-9
"""Chance of a good row six standard deviations off: it bounds that of the misread ones from above."""
_AGREES: Final = 4.0
"""A row agrees with a misreading if what is left is below so many standard deviations."""
_TELLS: Final = 8.0
"""A tilt that would differ by so many standard deviations tells whether the angle was wrong."""
_BEYOND_TAILS: Final = 15.0
"""Without a tilt that tells: no normal noise reaches so many standard deviations; with heavy tails one row may."""


@dataclass(frozen=True, kw_only=True)
class Misreading:
    """A row whose true angle is the reported one plus a round amount."""

    row: int
    error_deg: float


def _round_amounts_deg() -> FloatArray:
    """Wrong by tens of minutes, halves of a degree, degrees, fives and tens of degrees; the smallest first."""
    sizes = np.concatenate(
        [np.arange(1, 6) / 6.0, np.arange(2, 11) / 2.0, np.arange(6, 16, dtype=float), np.arange(20.0, 181.0, 5.0)]
    )
    both = np.stack([sizes, -sizes], axis=1).ravel()
    return np.asarray(both[:-1])


ROUND_AMOUNTS_DEG: Final = _round_amounts_deg()


def misreadings(whole: GyrocompassObservations, table: GyrocompassTable, fit: GyrocompassFit) -> tuple[Misreading, ...]:
    """Which of the gross errors that were set aside of `whole` are wrong angles, beside what was found."""
    aside = [entry.row for entry in table.observations.set_aside if entry.gross]
    found = (_look(whole, dwell, table, fit) for dwell in np.flatnonzero(np.isin(whole.row, aside)).tolist())
    return tuple(each for each in found if each is not None)


def _look(
    whole: GyrocompassObservations, dwell: int, table: GyrocompassTable, fit: GyrocompassFit
) -> Misreading | None:
    """A gross error as a misreading; None where it is none."""
    rows = _tried(whole, dwell)
    off = deviations(rows, table, fit)[len(whole) :] * np.sqrt(table.further_weights) / fit.dwell
    agrees, told = np.all(np.abs(off[:, :1]) < _AGREES, axis=1), np.zeros(len(off), dtype=bool)
    if off.shape[1] > 1:
        told = np.abs(off[:, 1] - off[0, 1]) > _TELLS
        agrees &= ~told | (np.abs(off[:, 1]) < _AGREES)
    agrees &= told | (abs(off[0, 0]) > _BEYOND_TAILS)
    agrees[0] = False
    if not agrees.any():
        return None
    best = int(np.argmin(np.where(agrees, np.sum(off**2, axis=1), np.inf)))
    return Misreading(row=int(whole.row[dwell]), error_deg=float(ROUND_AMOUNTS_DEG[best - 1]))


def _tried(whole: GyrocompassObservations, dwell: int) -> GyrocompassObservations:
    """A table with one of its dwells once more as it is, and at each angle that is a round amount away."""
    count = len(ROUND_AMOUNTS_DEG) + 1
    rows = whole.over(np.concatenate([np.arange(len(whole)), np.full(count, dwell)]))
    tried_deg = rows.azimuth_deg.copy()
    tried_deg[len(whole) + 1 :] += ROUND_AMOUNTS_DEG
    return replace(rows, azimuth_deg=tried_deg)


def as_effect(misread: Sequence[Misreading]) -> tuple[EffectFound, ...]:
    """Misread rows among the effects found; none where there are none."""
    if not misread:
        return ()
    return (
        EffectFound(
            name=MISREADING, also_possible=(), belongs_to="stand", coefficients={}, p_value=_P_VALUE, depends_on="angle"
        ),
    )


def misread_json(misread: Sequence[Misreading]) -> dict[str, Any]:
    """Which rows were misread, and what has to be added to their angles to have the true ones."""
    return {"rows": [entry.row for entry in misread], "error_deg": [entry.error_deg for entry in misread]}


def misread_text(misread: Sequence[Misreading]) -> str:
    """The same in words."""
    if not misread:
        return ""
    return series([Message("row {row} by {error_deg:g}°", row=each.row, error_deg=each.error_deg) for each in misread])
