"""What each condition of the publication costs in heading and drift, by simulation.

Meleshko, Kornejchuk, Skudneva 2008 claim 0.1° and 24.95 of 25 °/h for the conditions below. Three positions are taken
by the mended formula of `cramer`, each run at a heading, tilts and errors of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.cramer import coefficients, three_positions
from tumble.calibrations.methods.gyrocompass.expected import DriftNoise
from tumble.calibrations.methods.gyrocompass.geometry import EARTH_RATE_DEG_H
from tumble.messages import Message

RUNS: Final = 20_000
_POSITIONS: Final = 3


@dataclass(frozen=True, kw_only=True)
class Conditions:
    """Errors of one gyrocompassing in three positions; none of them unless it is given."""

    latitude_deg: float = 50.45
    delta_deg: tuple[float, float, float] = (0.0, 90.0, 180.0)
    dwell_s: float = 10.0
    """Averaging at each position."""
    turn_s: float = 10.0
    """From one position to the next."""
    most_tilt_deg: float = 5.0
    """The tilt γ is anywhere up to this at each position; β is held at 0, and both are measured."""
    drift_deg_h: float = 25.0
    gauss_markov_deg_h: float = 0.0
    """Standard deviation of the random drift."""
    correlation_s: float = 1000.0
    azimuth_systematic_deg: float = 0.0
    """Error of every turned position."""
    azimuth_random_deg: float = 0.0
    tilt_systematic_deg: float = 0.0
    tilt_random_deg: float = 0.0
    latitude_error_deg: float = 0.0


PUBLISHED: Final = Conditions(
    gauss_markov_deg_h=0.2,
    azimuth_systematic_deg=0.1,
    azimuth_random_deg=0.05,
    tilt_systematic_deg=10.0 / 60.0,
    tilt_random_deg=1.0 / 60.0,
    latitude_error_deg=0.1 / 60.0,
)
"""All conditions that are printed."""
_ALONE: Final[Mapping[Message, tuple[str, ...]]] = {
    Message("random drift, Gauss-Markov"): ("gauss_markov_deg_h",),
    Message("azimuth, systematic"): ("azimuth_systematic_deg",),
    Message("azimuth, random"): ("azimuth_random_deg",),
    Message("tilt, random"): ("tilt_random_deg",),
    Message("tilt, systematic"): ("tilt_systematic_deg",),
    Message("latitude"): ("latitude_error_deg",),
}


@dataclass(frozen=True, kw_only=True)
class Cost:
    """What a set of errors does, over many runs."""

    cause: str
    heading_rms_arcmin: float
    heading_95_deg: float
    """Not exceeded in 95% of the runs."""
    within_tenth: float
    """Part of the runs whose heading is within 0.1°."""
    drift_mean_deg_h: float
    drift_sd_deg_h: float

    @property
    def drift_rms_deg_h(self) -> float:
        """Root mean square."""
        return float(np.hypot(self.drift_mean_deg_h, self.drift_sd_deg_h))


def error_table(conditions: Conditions = PUBLISHED, runs: int = RUNS, seed: int = 2008) -> tuple[Cost, ...]:
    """Each cause by itself, then all of them."""
    clean = replace(Conditions(), **{name: getattr(conditions, name) for name in _FRAME})
    alone = [
        (cause, replace(clean, **{name: getattr(conditions, name) for name in names}))
        for cause, names in _ALONE.items()
    ]
    return tuple(cost(cause, each, runs, seed) for cause, each in [*alone, (Message("all"), conditions)])


_FRAME: Final = ("latitude_deg", "delta_deg", "dwell_s", "turn_s", "most_tilt_deg", "drift_deg_h", "correlation_s")
"""What is no error."""


def cost(cause: str, conditions: Conditions, runs: int = RUNS, seed: int = 2008) -> Cost:
    """What the errors of some conditions do to heading and drift."""
    heading_deg, drift_deg_h = simulated(conditions, runs, np.random.default_rng(seed))
    return Cost(
        cause=cause,
        heading_rms_arcmin=60.0 * float(np.sqrt(np.mean(heading_deg**2))),
        heading_95_deg=float(np.quantile(np.abs(heading_deg), 0.95)),
        within_tenth=float(np.mean(np.abs(heading_deg) < 0.1)),
        drift_mean_deg_h=float(drift_deg_h.mean()),
        drift_sd_deg_h=float(drift_deg_h.std()),
    )


def simulated(conditions: Conditions, runs: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """Errors of the heading in degrees and of the drift in °/h, each of shape (runs,).

    The drift of a run is its mean over a long time.
    """
    here, shape = conditions, (runs, _POSITIONS)
    alpha0_deg = rng.uniform(-180.0, 180.0, (runs, 1))
    gamma_deg = rng.uniform(-here.most_tilt_deg, here.most_tilt_deg, shape)
    delta_deg = np.array(here.delta_deg)
    turned = np.arange(_POSITIONS) > 0
    true_deg = delta_deg + turned * (here.azimuth_systematic_deg + here.azimuth_random_deg * rng.normal(size=shape))
    tilt_error_deg = here.tilt_systematic_deg + here.tilt_random_deg * rng.normal(size=(2, *shape))
    measured_deg = gamma_deg + tilt_error_deg[0]
    latitude = np.deg2rad(here.latitude_deg + here.latitude_error_deg)
    north, up = EARTH_RATE_DEG_H * np.cos(latitude), EARTH_RATE_DEG_H * np.sin(latitude)
    a, b = coefficients(true_deg, north, gamma_deg, 0.0)
    alpha0 = np.deg2rad(alpha0_deg)
    drift = here.drift_deg_h + _wandering(here, runs, rng)
    stated_up = EARTH_RATE_DEG_H * np.sin(np.deg2rad(here.latitude_deg))
    levelled = stated_up * np.sin(np.deg2rad(measured_deg)) - up * np.sin(np.deg2rad(gamma_deg))
    found = three_positions(
        a * np.sin(alpha0) + b * np.cos(alpha0) + drift + levelled,
        np.broadcast_to(delta_deg, shape),
        float(EARTH_RATE_DEG_H * np.cos(np.deg2rad(here.latitude_deg))),
        measured_deg,
        tilt_error_deg[1],
    )
    heading_deg = (found.alpha0_deg - alpha0_deg[:, 0] + 180.0) % 360.0 - 180.0
    return heading_deg, found.drift_deg_h - here.drift_deg_h


def _wandering(conditions: Conditions, runs: int, rng: np.random.Generator) -> FloatArray:
    """Mean of the random drift over each dwell, shape (runs, 3)."""
    starts_s: FloatArray = np.arange(_POSITIONS, dtype=float) * (conditions.dwell_s + conditions.turn_s)
    noise = DriftNoise(gauss_markov_deg_h=conditions.gauss_markov_deg_h, correlation_s=conditions.correlation_s)
    values, vectors = np.linalg.eigh(noise.covariance(starts_s, starts_s + conditions.dwell_s))
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    return np.asarray(rng.normal(size=(runs, _POSITIONS)) @ root.T)
