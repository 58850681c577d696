"""Effects that are not linear in their coefficient: each adds `matrix(value) @ K + own(value)` to the output.

They are sought as the secant from nothing to the point where they were found to fit best, and fitted in full: with the
coefficients as they were without the effect, one in which coefficients stand as factors is wrong by many deviations.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.model import COEFFICIENTS
from tumble.calibrations.methods.vibration.products import products_of
from tumble.calibrations.methods.vibration.scene import VibrationScene
from tumble.calibrations.tracing.effect import Form

_KILO: Final = 1e3
_PER_G: Final = 1e6
"""µg."""
_RATIOS: Final = (0.005, 0.01, *(0.02 * np.arange(1, 31)).tolist())
"""Of sideways motion, so close that the best of several minima is not passed over."""
_ABOVE: Final = tuple(np.geomspace(1.05, 30.0, 30).tolist())
"""Resonances that are tried, in multiples of the highest frequency of a table."""
_DEPTHS: Final = tuple(np.geomspace(5e-5, 0.35, 30).tolist())
"""Parts of the largest input by which a limit may lie below it."""


@dataclass(frozen=True, kw_only=True)
class Shares:
    """What an effect adds to the rows: `matrix @ K + own`, in µg."""

    matrix: FloatArray
    """In g², shape (rows, 5)."""
    own: FloatArray
    """In µg, shape (rows,)."""

    def added(self, coefficients: FloatArray) -> FloatArray:
        """What it adds with these K, shape (rows,)."""
        return np.asarray(self.matrix @ coefficients + self.own)


@dataclass(frozen=True, kw_only=True)
class Curved:
    """A nonlinear effect of one value."""

    name: str
    tried: Callable[[VibrationScene], Sequence[float]]
    """Values from which a fit may start; none where the table cannot show it."""
    shares: Callable[[VibrationScene, float], Shares]
    allowed: tuple[float, float]
    """Values that mean anything."""

    def forms(self, scene: VibrationScene) -> Sequence[Form]:
        """Its secant, so that the coefficient is the value itself; none where there is no point to draw it to."""
        point = scene.points.get(self.name)
        if point is None:
            return ()
        column = self.shares(scene, point.value).added(point.coefficients) / point.value
        return (Form(columns=column[:, None]),) if column.any() else ()


def _nothing(scene: VibrationScene) -> FloatArray:
    return np.zeros(scene.rows)


def _cross_shares(scene: VibrationScene, ratio: float) -> Shares:
    """In-phase sideways motion ρ: the table moves along q = s + ρ l in place of s."""
    rows = scene.observations
    drive, lateral = rows.along("drive_"), rows.along("lateral_")
    change = products_of(drive + ratio * lateral) - products_of(drive)
    return Shares(matrix=scene.power_g2[:, None] * change * scene.shaken[:, None], own=_nothing(scene))


def _ratios(scene: VibrationScene) -> Sequence[float]:
    if not (scene.shaken.any() and scene.observations.along("lateral_").any()):
        return ()
    return (*_RATIOS, *(-ratio for ratio in _RATIOS))


def magnification(frequency_hz: FloatArray, natural_hz: float) -> FloatArray:
    """H of a resonance without damping, 1 / (1 - (f/fn)²)."""
    return np.asarray(1.0 / (1.0 - np.minimum((frequency_hz / natural_hz) ** 2, 0.98)))


def _response_shares(scene: VibrationScene, inverse_khz2: float) -> Shares:
    natural_hz = _KILO / np.sqrt(max(inverse_khz2, 1e-12))
    gain = magnification(scene.frequency_hz, natural_hz) ** 2 - 1.0
    matrix = np.zeros((scene.rows, COEFFICIENTS))
    matrix[:, 0] = scene.products_g2[:, 0] * gain
    return Shares(matrix=matrix, own=_nothing(scene))


def _resonances(scene: VibrationScene) -> Sequence[float]:
    frequencies = scene.frequency_hz[scene.products_g2[:, 0] > 0.0]
    if len(np.unique(np.round(frequencies[frequencies > 0.0], 1))) < 2:
        return ()
    return [(_KILO / (ratio * float(frequencies.max()))) ** 2 for ratio in _ABOVE]


def clipped_mean_ug(peak_g: FloatArray, static_g: FloatArray, limit_g: float) -> FloatArray:
    """Mean over a period of what a limit cuts off the top of static + peak sin, in µg, negative."""
    cosine = np.clip((limit_g - static_g) / np.maximum(peak_g, 1e-12), -1.0, 1.0)
    cut = peak_g * np.sqrt(1.0 - cosine**2) - (limit_g - static_g) * np.arccos(cosine)
    return np.asarray(np.where(static_g + peak_g > limit_g, -_PER_G / np.pi * cut, 0.0))


def _clip_shares(scene: VibrationScene, limit_g: float) -> Shares:
    own = clipped_mean_ug(scene.peak_g[:, 0], scene.gravity_g[:, 0], limit_g)
    return Shares(matrix=np.zeros((scene.rows, COEFFICIENTS)), own=own)


def _limits(scene: VibrationScene) -> Sequence[float]:
    largest = float((scene.peak_g[:, 0] + scene.gravity_g[:, 0]).max(initial=0.0))
    return [largest * (1.0 - depth) for depth in _DEPTHS] if scene.peak_g[:, 0].any() else ()


CROSS: Final = Curved(name="shaker_cross", tried=_ratios, shares=_cross_shares, allowed=(-2.0, 2.0))
RESPONSE: Final = Curved(name="frequency_response", tried=_resonances, shares=_response_shares, allowed=(1e-9, 1e9))
CLIPPING: Final = Curved(name="clipping", tried=_limits, shares=_clip_shares, allowed=(1e-3, 1e6))
CURVED: Final = {each.name: each for each in (CROSS, RESPONSE, CLIPPING)}
