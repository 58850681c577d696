"""A simulated gyro platform on a turntable: full rotation matrices, no line shared with the analysis.

The base leans, the turntable turns in it about its leaning axis, the platform on it levels one of its axes. The rate is
the scalar product of the earth rate with the other axis. Effects act on the true angles, on the rates or on the tilts,
wherever nature has them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

U_DEG_H = 15.041068
DWELL_S = 60.0
TURN_S = 25.0
REST_S = 15.0
PAUSE_S = 260.0
SAMPLES = 600
TILT_NOISE_DEG = 1.4e-4
Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Design:
    """Angles of one pass, and how it is repeated."""

    angles_deg: tuple[float, ...]
    passes: int
    there_and_back: bool = True
    bases: int = 1
    lean_deg: float = 0.3
    shuffled: bool = False


@dataclass
class Dwells:
    """What effects may change, dwell by dwell."""

    delta_deg: Array
    direction: Array
    realisation: Array
    base: Array
    time_s: Array
    temperature_k: Array
    """Above 23 °C."""
    error_deg: Array = field(default_factory=lambda: np.zeros(0))
    """True pickoff angle minus reported."""
    yaw_deg: Array = field(default_factory=lambda: np.zeros(0))
    """Turn of the base."""
    latitude_error_deg: float = 0.0
    tilt_scale: float = 0.0
    tilt_bias_deg: float = 0.0

    def __post_init__(self) -> None:
        """Nothing is wrong yet."""
        self.error_deg, self.yaw_deg = np.zeros(len(self.delta_deg)), np.zeros(len(self.delta_deg))

    @property
    def hours(self) -> Array:
        """Since the first dwell."""
        return np.asarray((self.time_s - self.time_s[0]) / 3600.0)


@dataclass(frozen=True)
class Platform:
    """What is to be found."""

    alpha0_deg: float
    drift_deg_h: float
    latitude_deg: float
    leans_deg: tuple[tuple[float, float], ...]
    """Tilts of both axes of each base at pickoff angle 0."""


Stand = Callable[[Dwells, float], None]
"""Changes dwells by an effect of a size."""
Unit = Callable[[Dwells, Array, Array, float], Array]
"""From dwells, true rates in °/h, sines of the tilts and a size: what is added to the rates."""


@dataclass(frozen=True)
class Made:
    """A table, and what went into it."""

    columns: Mapping[str, Array]
    platform: Platform
    clean_deg_h: Array
    effect_deg_h: Array
    noise_deg_h: float
    drift_deg_h: float
    """As it is reported."""


def axis(dwells: Dwells, platform: Platform) -> Array:
    """The platform's input axis in east, north, up, shape (dwells, 3)."""
    found = np.zeros((len(dwells.delta_deg), 3))
    for number, (gamma, kappa) in enumerate(platform.leans_deg):
        its = dwells.base == number
        base = Rotation.from_euler("ZYX", [platform.alpha0_deg, gamma, kappa], degrees=True)
        turned = Rotation.from_euler("z", (dwells.delta_deg + dwells.error_deg)[its][:, None], degrees=True)
        yaw = Rotation.from_euler("z", dwells.yaw_deg[its][:, None], degrees=True)
        found[its] = (yaw * base * turned).apply(np.array([1.0, 0.0, 0.0]))
    return found


def rates(dwells: Dwells, platform: Platform) -> tuple[Array, Array, Array]:
    """Reported rate without noise and torquer, sine of the true tilt, tilt as measured in degrees."""
    latitude = np.deg2rad(platform.latitude_deg + dwells.latitude_error_deg)
    along = axis(dwells, platform)
    north, up = U_DEG_H * np.cos(latitude), U_DEG_H * np.sin(latitude)
    sin_tilt = -along[:, 2]
    tilt_deg = (1 + dwells.tilt_scale) * np.rad2deg(np.arcsin(sin_tilt)) + dwells.tilt_bias_deg
    raw = north * along[:, 1] + up * along[:, 2] + platform.drift_deg_h
    return raw + up * np.sin(np.deg2rad(tilt_deg)), sin_tilt, tilt_deg


def draw_platform(rng: np.random.Generator, design: Design) -> Platform:
    """A platform anywhere, with a drift as they come."""
    leans = rng.normal(0.0, design.lean_deg, (design.bases, 2))
    return Platform(
        alpha0_deg=float(rng.uniform(-180.0, 180.0)),
        drift_deg_h=float(rng.normal(0.0, 8.0)),
        latitude_deg=float(np.round(rng.uniform(30.0, 60.0), 4)),
        leans_deg=tuple((float(a), float(b)) for a, b in leans),
    )


def dwells_of(rng: np.random.Generator, design: Design, warm_k: float) -> Dwells:
    """Dwells of a design in their order."""
    delta, direction, realisation, base, time_s = [], [], [], [], []
    now_s, before = 0.0, 0.0
    for number in range(design.bases):
        for visit in range(design.passes):
            now_s += PAUSE_S
            one = list(design.angles_deg)
            if design.shuffled:
                one = list(rng.permutation(one))
            for angle in [*one, *reversed(one)] if design.there_and_back else one:
                moved = np.sign(angle - before)
                now_s += (TURN_S if moved else REST_S) + DWELL_S
                direction.append(moved or (direction[-1] if direction else 1.0))
                delta.append(angle)
                realisation.append(number * design.passes + visit + 1)
                base.append(number)
                time_s.append(now_s - DWELL_S / 2)
                before = angle
    times = np.array(time_s)
    part = times / times[-1]
    temperature_k = 0.1 * np.sin(2 * np.pi * part * 1.3 + rng.uniform(0, 6)) + rng.normal(0.0, 0.03, len(times))
    temperature_k += warm_k * (np.sin(2 * np.pi * part * 2.2 + rng.uniform(0, 6)) + 0.6 * np.cos(5.0 * part))
    return Dwells(
        delta_deg=np.array(delta),
        direction=np.array(direction),
        realisation=np.array(realisation, dtype=float),
        base=np.array(base),
        time_s=times,
        temperature_k=temperature_k,
    )


def make(
    rng: np.random.Generator,
    design: Design,
    stand: Sequence[tuple[Stand, float]] = (),
    unit: Sequence[tuple[Unit, float]] = (),
    warm_k: float = 0.0,
    noise_deg_h: float = 0.01,
    reported: float = 1.0,
) -> Made:
    """A table of a platform, with effects of given sizes; `reported` is the torquer's factor, which the drift keeps."""
    platform = draw_platform(rng, design)
    dwells = dwells_of(rng, design, warm_k)
    clean, _, _ = rates(dwells, platform)
    for change, size in stand:
        change(dwells, size)
    turned, sin_tilt, tilt_deg = rates(dwells, platform)
    added = sum((add(dwells, turned, sin_tilt, size) for add, size in unit), np.zeros(len(clean)))
    output = turned + added + rng.normal(0.0, noise_deg_h, len(clean))
    tilt_deg = tilt_deg + rng.normal(0.0, TILT_NOISE_DEG, len(clean))
    deviation = noise_deg_h * np.sqrt(SAMPLES) * (1 + rng.normal(0.0, 1 / np.sqrt(2 * SAMPLES), len(clean)))
    columns = {
        "time_s": dwells.time_s,
        "realisation": dwells.realisation,
        "base": dwells.base + 1.0,
        "azimuth_deg": dwells.delta_deg,
        "direction": dwells.direction,
        "tilt_gamma_deg": tilt_deg,
        "latitude_deg": np.full(len(clean), platform.latitude_deg),
        "dwell_s": np.full(len(clean), DWELL_S),
        "temperature_degC": 23.0 + dwells.temperature_k,
        "rate_deg_h": output,
        "rate_sd_deg_h": deviation,
        "samples": np.full(len(clean), float(SAMPLES)),
    }
    effect = turned + added - clean
    return Made(
        columns=columns,
        platform=platform,
        clean_deg_h=clean,
        effect_deg_h=effect,
        noise_deg_h=noise_deg_h,
        drift_deg_h=reported * platform.drift_deg_h,
    )
