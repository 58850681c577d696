"""Tells wrong angles from other gross errors: a round amount that explains the rate, and the tilt where that tells."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions
from tumble.calibrations.methods.gyrocompass.lean import Lean
from tumble.calibrations.methods.gyrocompass.model import NAMES
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
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
    """Which of the gross errors that were set aside of `whole` are wrong angles."""
    aside = [entry.row for entry in table.observations.set_aside if entry.gross]
    found = (_look(whole.over(np.flatnonzero(whole.row == row)), table, fit) for row in aside)
    return tuple(each for each in found if each is not None)


def _look(row: GyrocompassObservations, table: GyrocompassTable, fit: GyrocompassFit) -> Misreading | None:
    """A gross error as a misreading; None where it is none."""
    if not len(row):
        return None
    lean = _lean_of(row, table)
    tried_rad = np.deg2rad(row.azimuth_deg[0] + np.concatenate([[0.0], ROUND_AMOUNTS_DEG]))
    off = (row.rate_deg_h[0] - _rates(tried_rad, row, lean, fit)) / fit.dwell
    agrees = np.abs(off) < _AGREES
    told, misfit = np.zeros(len(off), dtype=bool), off**2
    if table.scene.with_tilts and row.tilt_gamma_deg is not None:
        deviation = fit.dwell / np.sqrt(table.weights[1])
        tilts = lean.sin_tilt(tried_rad)
        away = np.abs(np.sin(np.deg2rad(row.tilt_gamma_deg[0])) - tilts) / deviation
        told = np.abs(tilts - tilts[0]) > _TELLS * deviation
        agrees &= ~told | (away < _AGREES)
        misfit = misfit + away**2
    agrees &= told | (abs(off[0]) > _BEYOND_TAILS)
    agrees[0] = False
    if not agrees.any():
        return None
    best = int(np.argmin(np.where(agrees, misfit, np.inf)))
    return Misreading(row=int(row.row[0]), error_deg=float(ROUND_AMOUNTS_DEG[best - 1]))


def _lean_of(row: GyrocompassObservations, table: GyrocompassTable) -> Lean:
    """The lean of the base on which a row was taken; of the first where no other row was."""
    bases, own = table.observations.base, row.base
    same = np.zeros(len(table.observations), dtype=bool) if bases is None or own is None else bases == own[0]
    return table.scene.lean.over(np.array([int(np.argmax(same))]))


def _rates(tried_rad: FloatArray, row: GyrocompassObservations, lean: Lean, fit: GyrocompassFit) -> FloatArray:
    count = len(tried_rad)
    alpha0, drift = fit.theta[: len(NAMES)]
    shown = heading_functions(tried_rad, np.repeat(row.latitude_deg, count), lean.over(np.zeros(count, dtype=np.int64)))
    return np.asarray(shown @ np.array([np.sin(alpha0), np.cos(alpha0)]) + drift)


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
