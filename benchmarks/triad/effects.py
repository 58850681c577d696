"""Effects of the simulated world, by their word of the contract."""

from collections.abc import Mapping

import numpy as np

from benchmarks.triad.world import Array, Dwells, Stand, Unit

_AXES = {"x": 0, "y": 1, "z": 2}


def _in_channel(channel: int, values: Array) -> Array:
    out = np.zeros((len(values), 3))
    out[:, channel] = values
    return out


def _product(channel: str, axes: str) -> Unit:
    def add(_: Dwells, gravity: Array, __: Array, size: float) -> Array:
        return _in_channel(_AXES[channel], size * np.prod([gravity[:, _AXES[axis]] for axis in axes], axis=0))

    return add


def _each(values: Array, size: float, felt: Array | None = None) -> Array:
    """All channels, each with a part of its own."""
    parts = size * np.array([1.0, -0.7, 0.4])
    whole = values if values.ndim == 2 else np.repeat(values[:, None], 3, axis=1)
    return whole * parts * (1.0 if felt is None else felt)


UNIT: Mapping[str, Unit] = {
    **{f"{c}.k_{p}": _product(c, p) for c in "xyz" for p in ("xx", "yy", "zz", "xy", "xz", "yz", c * 3)},
    **{
        f"{c}.scale_asymmetry": (
            lambda _, g, __, size, place=place: _in_channel(place, size * np.abs(g[:, place]))
        )
        for c, place in _AXES.items()
    },
    "bias_temperature": lambda d, _, __, size: _each(d.temperature_k, size),
    "scale_temperature": lambda d, g, __, size: _each(d.temperature_k, size, g),
    "bias_drift": lambda d, _, __, size: _each((d.time_s - d.time_s[0]) / 3600.0, size),
    "scale_drift": lambda d, g, __, size: _each((d.time_s - d.time_s[0]) / 3600.0, size, g),
    "warm_up": lambda d, _, __, size: _each(np.exp(-(d.time_s - d.time_s[0]) / 1500.0), size),
    "settling": lambda _, __, v, size: size * np.vstack([np.zeros(3), v[:-1] - v[1:]]),
    "daq_nonlinearity": lambda _, __, v, size: size * np.sin(2 * np.pi * v / 0.61 + 0.8),
    "range_step": lambda _, __, v, size: size * (v > 0.31),
}  # fmt: skip


def _outer(shape: str, order: int = 1, phase: float = 0.9) -> Stand:
    def change(dwells: Dwells, size: float) -> None:
        angle = np.deg2rad(dwells.outer_deg if shape == "outer" else dwells.inner_deg)
        error = size * np.sin(order * angle + phase)
        if shape == "outer":
            dwells.outer_error = dwells.outer_error + error
        else:
            dwells.inner_error = dwells.inner_error + error

    return change


def _backlash(axis: str) -> Stand:
    def change(dwells: Dwells, size: float) -> None:
        if axis == "outer":
            dwells.outer_error = dwells.outer_error + size * (dwells.outer_direction < 0)
        else:
            dwells.inner_error = dwells.inner_error + size * (dwells.inner_direction < 0)

    return change


def _square(dwells: Dwells, size: float) -> None:
    dwells.square += size


def _outer_wobble(dwells: Dwells, size: float) -> None:
    dwells.level_y = dwells.level_y + size * np.sin(2 * np.deg2rad(dwells.outer_deg) + 0.6)


def _inner_wobble(dwells: Dwells, size: float) -> None:
    angle = 2 * np.deg2rad(dwells.inner_deg) + 0.6
    dwells.arm = dwells.arm + size * np.column_stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)])


def _level_drift(dwells: Dwells, size: float) -> None:
    hours = (dwells.time_s - dwells.time_s[0]) / 3600.0
    dwells.level_x = dwells.level_x + size * hours
    dwells.level_y = dwells.level_y - 0.6 * size * hours


STAND: Mapping[str, Stand] = {
    "axes_orthogonality": _square,
    "outer_eccentricity": _outer("outer"),
    "inner_eccentricity": _outer("inner"),
    "outer_second_harmonic": _outer("outer", 2),
    "inner_second_harmonic": _outer("inner", 2),
    "outer_backlash": _backlash("outer"),
    "inner_backlash": _backlash("inner"),
    "outer_wobble": _outer_wobble,
    "inner_wobble": _inner_wobble,
    "level_drift": _level_drift,
}
