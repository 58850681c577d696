"""The published method, equation by equation, as a baseline to compare with.

Avrutov, Bondar, Meleshko 2008, equations (4) to (18). Two things are put right: the arctangent of (18) is taken on the
branch |alpha0| < 45 deg with kxy carrying its own sign (the printed square root is never negative), and kz, which the
sweep does not see, comes from the z flip (11).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.methods.dividing_head.flips import POLES, at_pole
from tumble.calibrations.methods.dividing_head.model import PARAMETERS
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class PublishedValue:
    """A parameter by the published equations."""

    value: float | None
    standard_uncertainty: float | None
    """Standard deviation between realisations over the root of their number; None with fewer than two."""
    reason: str = ""


def published_method(observations: Observations) -> dict[str, PublishedValue]:
    """u0, kx, ky, kxy and alpha0 from each realisation's face-up sweep by (14) to (18), kz from its z flip by (11).

    Without a sweep u0, kx and ky come from the flips by (4), (5) and (8). Values are means over realisations.
    """
    per_realisation = [
        _one_realisation(observations.select(observations.realisations == number))
        for number in np.unique(observations.realisations)
    ]
    return {name: _summary(name, [values[name] for values in per_realisation if name in values])
            for name in PARAMETERS}  # fmt: skip


def _summary(name: str, values: list[float]) -> PublishedValue:
    if not values:
        reason = Message("needs a z flip") if name == "kz" else Message("needs a face-up sweep or flip")
        return PublishedValue(value=None, standard_uncertainty=None, reason=reason)
    spread = float(np.std(values, ddof=1) / np.sqrt(len(values))) if len(values) > 1 else None
    return PublishedValue(value=float(np.mean(values)), standard_uncertainty=spread)


def _one_realisation(observations: Observations) -> dict[str, float]:
    return {**_flips(observations), **_sweep(observations)}


def _flips(observations: Observations) -> dict[str, float]:
    """Equations (4), (5), (8) and (11): half sum and half difference of the two poles."""
    found: dict[str, float] = {}
    for axis, (mount, *poles) in POLES.items():
        down, up = (observations.output_v[at_pole(observations, mount, pole)] for pole in poles)
        if len(down) and len(up):
            found[f"k{axis}"] = float(down.mean() - up.mean()) / 2
            if axis == "x":
                found["u0"] = float(down.mean() + up.mean()) / 2
    return found


def _sweep(observations: Observations) -> dict[str, float]:
    """Equations (14) to (18) on the face-up sweep; nothing where the sweep does not determine the five coefficients."""
    rows = _sweep_rows(observations)
    alpha = np.deg2rad(observations.angle_deg[rows])
    matrix = np.column_stack([np.ones_like(alpha), np.sin(alpha), np.cos(alpha), np.sin(2 * alpha), np.cos(2 * alpha)])
    if len(alpha) < 5 or np.linalg.matrix_rank(matrix, tol=1e-6 * len(alpha)) < 5:
        return {}
    c0, c1, c2, c3, c4 = np.linalg.lstsq(matrix, observations.output_v[rows], rcond=None)[0]
    alpha0 = 0.5 * np.arctan(c4 / c3) if c3 else 0.0
    return {
        "u0": float(c0),
        "kx": float(-(c1 * np.cos(alpha0) + c2 * np.sin(alpha0))),
        "ky": float(c1 * np.sin(alpha0) - c2 * np.cos(alpha0)),
        "kxy": float(2 * (c3 * np.cos(2 * alpha0) + c4 * np.sin(2 * alpha0))),
        "alpha0": float(np.rad2deg(alpha0)),
    }


def _sweep_rows(observations: Observations) -> NDArray[np.bool_]:
    rows = observations.mounts == "face-up"
    return np.asarray(rows if observations.procedure is None else rows & (observations.procedure == "sweep"))
