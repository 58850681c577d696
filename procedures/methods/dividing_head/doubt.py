"""Whether a voltage contradicts the angle that was read, and which slip would explain it.

The commonest gross error at a head that is read by hand is one wrong digit: a degree or a minute, or ten of them. The
output in one mount is `c + s sin φ + k cos φ + s' sin 2φ + k' cos 2φ`: bias, two axes and their product (Avrutov,
Bondar, Meleshko 2008, equation 12). It is fitted to the points taken so far in that mount.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.messages import Message
from tumble.procedures.methods.dividing_head.rows import Row

_TERMS = 5
_FEWEST = _TERMS + 4
"""Points without which nothing is doubted."""
_DOUBTED = 6.0
"""Standard deviations beyond which a voltage contradicts a reading."""
_EXPLAINED = 3.0
_DEGREE, _MINUTE = Message("degree"), Message("minute")
_SLIPS = [(1.0, _DEGREE), (10.0, _DEGREE), (1 / 60, _MINUTE), (10 / 60, _MINUTE), (100.0, _DEGREE)]


@dataclass(frozen=True, kw_only=True)
class Doubt:
    """A reading that the voltage contradicts."""

    off_v: float
    """Measured minus expected."""
    likely_deg: float | None = None
    """A reading that the voltage fits, one digit away; None where there is none."""
    slip: str = ""
    """`degree` or `minute`."""


def doubt(row: Row, rows: Sequence[Row]) -> Doubt | None:
    """What is to be said against the angle of `row`; None where nothing is, or too little is known yet."""
    same = [other for other in rows if other.mount == row.mount and math.isfinite(other.voltage_v)]
    angles_deg = np.array([other.angle_deg for other in same])
    if len(same) < _FEWEST or not math.isfinite(row.voltage_v):
        return None
    design = _design(angles_deg)
    voltage_v = np.array([other.voltage_v for other in same])
    coefficients, _, rank, _ = np.linalg.lstsq(design, voltage_v, rcond=1e-6)
    if rank < _TERMS:
        return None
    residual_v = voltage_v - design @ coefficients
    scatter_v = math.sqrt(float(residual_v @ residual_v) / (len(same) - _TERMS))
    expected_v, spread = _expected(row.angle_deg, coefficients, np.linalg.inv(design.T @ design))
    sigma_v = max(scatter_v, row.voltage_sd_v / math.sqrt(row.samples)) * spread
    off_v = row.voltage_v - expected_v
    if abs(off_v) <= _DOUBTED * sigma_v:
        return None
    return _explained(row, off_v, coefficients, _EXPLAINED * sigma_v)


def _explained(row: Row, off_v: float, coefficients: NDArray[np.float64], window_v: float) -> Doubt:
    """Look for one wrong digit, the smallest slip first."""
    for digits in range(1, 10):
        for unit_deg, slip in _SLIPS:
            for sign in (1, -1):
                likely_deg = row.angle_deg + sign * digits * unit_deg
                if abs(row.voltage_v - float(_design(np.array([likely_deg]))[0] @ coefficients)) <= window_v:
                    return Doubt(off_v=off_v, likely_deg=likely_deg, slip=slip)
    return Doubt(off_v=off_v)


def _design(angles_deg: NDArray[np.float64]) -> NDArray[np.float64]:
    angle_rad = np.deg2rad(angles_deg)
    terms = [np.sin(angle_rad), np.cos(angle_rad), np.sin(2 * angle_rad), np.cos(2 * angle_rad)]
    return np.stack([np.ones_like(angle_rad), *terms], axis=-1)


def _expected(
    angle_deg: float, coefficients: NDArray[np.floating], inverse: NDArray[np.floating]
) -> tuple[float, float]:
    """Voltage at an angle, and the standard deviation of a new measurement about it in units of a single one's."""
    row = _design(np.array([angle_deg]))[0]
    return float(row @ coefficients), math.sqrt(1.0 + float(row @ inverse @ row))
