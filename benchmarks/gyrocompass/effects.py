"""Effects of the simulated world, by their word of the contract, and kinds that no catalogue has."""

from collections.abc import Mapping

import numpy as np

from benchmarks.gyrocompass.world import U_DEG_H, Array, Dwells, Stand, Unit


def _harmonic(order: int, phase: float) -> Stand:
    def change(dwells: Dwells, size: float) -> None:
        dwells.error_deg = dwells.error_deg + size * np.sin(order * np.deg2rad(dwells.delta_deg) + phase)

    return change


def _pickoff_scale(dwells: Dwells, size: float) -> None:
    dwells.error_deg = dwells.error_deg + size * dwells.delta_deg


def _backlash(dwells: Dwells, size: float) -> None:
    dwells.error_deg = dwells.error_deg + size * (dwells.direction < 0)


def _yaw(dwells: Dwells, size: float) -> None:
    dwells.yaw_deg = dwells.yaw_deg + size * dwells.hours


def _latitude(dwells: Dwells, size: float) -> None:
    dwells.latitude_error_deg += size


def _tilt_scale(dwells: Dwells, size: float) -> None:
    dwells.tilt_scale += size


def _tilt_bias(dwells: Dwells, size: float) -> None:
    dwells.tilt_bias_deg += size


STAND: Mapping[str, Stand] = {
    "pickoff_eccentricity": _harmonic(1, 0.8),
    "pickoff_second_harmonic": _harmonic(2, 0.4),
    "pickoff_graduation": _harmonic(3, 0.7),
    "pickoff_scale": _pickoff_scale,
    "backlash": _backlash,
    "base_yaw": _yaw,
    "latitude": _latitude,
    "tilt_scale": _tilt_scale,
    "tilt_bias": _tilt_bias,
}


def _walk(dwells: Dwells, _: Array, __: Array, size: float) -> Array:
    rng = np.random.default_rng(int(1e6 * abs(size)) + len(dwells.hours))
    steps = rng.normal(0.0, np.sqrt(np.diff(dwells.hours, prepend=0.0)))
    path = np.cumsum(steps)
    return np.asarray(size * (path - path.mean()))


def _jumps(dwells: Dwells, _: Array, __: Array, size: float) -> Array:
    count = int(dwells.realisation.max())
    rng = np.random.default_rng(int(1e6 * abs(size)) + count)
    levels = rng.normal(0.0, 1.0, count)
    return np.asarray(size * (levels - levels.mean())[dwells.realisation.astype(int) - 1])


def _settling(dwells: Dwells, rate: Array, __: Array, size: float) -> Array:
    """What the levelling loop has not yet forgotten of the reading before, within one go."""
    out = rate.copy()
    for row in range(1, len(out)):
        if dwells.time_s[row] - dwells.time_s[row - 1] < 150.0:
            out[row] = rate[row] + size * (out[row - 1] - rate[row])
    return out - rate


UNIT: Mapping[str, Unit] = {
    "drift_ramp": lambda d, _, __, s: s * d.hours,
    "drift_warm_up": lambda d, _, __, s: s * np.exp(-d.hours / (0.12 * d.hours[-1])),
    "drift_temperature": lambda d, _, __, s: s * d.temperature_k,
    "drift_random_walk": _walk,
    "realisation_drift": _jumps,
    "torquer_scale": lambda _, rate, __, s: s * rate,
    "torquer_asymmetry": lambda _, rate, __, s: s * np.abs(rate),
    "torquer_square": lambda _, rate, __, s: s * rate**2,
    "g_unbalance": lambda _, __, tilt, s: s * tilt,
    "settling": _settling,
}

NOVEL: Mapping[str, tuple[Unit, str]] = {
    "dead_zone": (lambda _, r, __, s: s * np.exp(-((r / 1.5) ** 2)), "rate"),
    "saturation": (lambda _, r, __, s: -s * np.sign(r) * np.maximum(np.abs(r) - 0.7 * np.abs(r).max(), 0.0), "rate"),
    "cube": (lambda _, r, __, s: s * (r / U_DEG_H) ** 3, "rate"),
    "magnet": (lambda d, _, __, s: s * np.exp(3.0 * np.cos(np.deg2rad(d.delta_deg - 130.0))), "angle"),
    "jump": (lambda d, _, __, s: s * (d.hours > 0.43 * d.hours[-1]), "time"),
    "wave": (lambda d, _, __, s: s * np.sin(2 * np.pi * d.hours / (0.23 * d.hours[-1])), "time"),
    "bend": (lambda d, _, __, s: s * (d.hours / d.hours[-1] - 0.4) ** 2, "time"),
    "thermal_bend": (lambda d, _, __, s: s * (d.temperature_k - 0.4) ** 2, "temperature"),
    "thermal_step": (lambda d, _, __, s: s * (d.temperature_k > 0.5), "temperature"),
}


def _detent(dwells: Dwells, size: float) -> None:
    away = (dwells.delta_deg - 210.0 + 180.0) % 360.0 - 180.0
    dwells.error_deg = dwells.error_deg + size * np.exp(-0.5 * (away / 35.0) ** 2)


NOVEL_STAND: Mapping[str, tuple[Stand, str]] = {"detent": (_detent, "angle")}
"""With the variable on which it depends."""
