"""Probes: dwells in mountings, phases, senses and kinds of vibration that a table may not have seen."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.joining import appended
from tumble.calibrations.methods.vibration.effects.stand import STANDARD_GRAVITY_M_S2
from tumble.calibrations.methods.vibration.observations import (
    AXES,
    DOUBLE_CENTRIFUGE,
    MULTI_SHAKER,
    SHAKER,
    VibrationObservations,
)
from tumble.messages import Message

STEP_S: Final = 75.0
"""Time from dwell to dwell where no table says it."""
_MOUNTING_S: Final = 300.0
_LEVELS_G: Final = (2.0, 4.0, 6.0, 8.0, 10.0)
_OCTAVES: Final = (40.0, 80.0, 160.0, 320.0)
_ARM_M: Final = 0.5
"""Radius of the double centrifuge."""
_RATES_HZ: Final = (1.0, -2.0, 4.0, -8.0)
_HALF: Final = float(np.sqrt(0.5))


@dataclass(frozen=True, kw_only=True)
class Shake:
    """One dwell of a probe; vectors along the axes i, o, p of the unit."""

    level_g: float = 0.0
    peak_g: tuple[float, float, float] = (0.0, 0.0, 0.0)
    frequency_hz: tuple[float, float, float] = (0.0, 0.0, 0.0)
    phase_deg: tuple[float, float, float] = (0.0, 0.0, 0.0)
    main_rad_s: float = 0.0
    sub_rad_s: float = 0.0
    random: bool = False


@dataclass(frozen=True, kw_only=True)
class Mounting:
    """How the unit sits, and the dwells in it; between any two it is at rest."""

    apparatus: str = SHAKER
    drive: tuple[float, float, float] = (0.0, 0.0, 0.0)
    lateral: tuple[float, float, float] = (0.0, 0.0, 0.0)
    gravity_g: tuple[float, float, float] = (0.0, 1.0, 0.0)
    shakes: tuple[Shake, ...]

    @property
    def dwells(self) -> Iterator[Shake]:
        """Those under vibration with rests about them."""
        yield Shake()
        for shake in self.shakes:
            yield shake
            yield Shake()


@dataclass(frozen=True, kw_only=True)
class VibrationProbe:
    """Dwells in one or more mountings, in a run of their own."""

    programme: str
    """Name of the programme that comes along."""
    does: Message
    """What it changes, to stand after its name."""
    mountings: tuple[Mounting, ...]
    step_s: float = STEP_S
    """Time from dwell to dwell."""

    @property
    def stand_time_s(self) -> float:
        """Time that it takes."""
        dwells = sum(2 * len(each.shakes) + 1 for each in self.mountings)
        return self.step_s * dwells + _MOUNTING_S * len(self.mountings)

    @property
    def command(self) -> str:
        """What to type to run it."""
        return f"tumble run --programme {self.programme} --serial SERIAL"

    @property
    def pairs(self) -> bool:
        """Each is planned by itself, or several times."""
        return False

    def after(self, rows: VibrationObservations) -> VibrationObservations:
        """A table with the dwells that it would add; temperature and uncertainty stay as they were last."""
        listed = [(each, shake) for each in self.mountings for shake in each.dwells]
        columns = _columns(listed)
        first = int((np.zeros(1) if rows.mounting is None else rows.mounting).max()) + 1
        numbers = np.repeat(np.arange(len(self.mountings)), [2 * len(each.shakes) + 1 for each in self.mountings])
        columns["mounting"] = numbers + first
        columns["row"] = np.arange(1, len(listed) + 1)
        if rows.time_s is not None:
            own_s = self.step_s * np.arange(1, len(listed) + 1) + _MOUNTING_S * (numbers + 1)
            columns["time_s"] = rows.time_s[-1] + own_s
        if rows.realisation is not None:
            columns["realisation"] = np.ones(len(listed), dtype=np.int64)
        return appended(_complete(rows), replace(_complete(rows).lasting(len(listed)), **columns))


def _complete(rows: VibrationObservations) -> VibrationObservations:
    """The same with every column that a probe sets, so that none is left out of both."""
    empty: dict[str, Any] = {
        name: np.zeros(len(rows))
        for name, column in rows.columns().items()
        if name in _NUMBERS and getattr(rows, name) is None and column.name
    }
    if rows.apparatus is None:
        empty["apparatus"] = rows.of_apparatus
    if rows.mounting is None:
        empty["mounting"] = np.ones(len(rows), dtype=np.int64)
    if rows.mii_g2 is None:
        empty |= {name: np.full(len(rows), np.nan) for name in _PRODUCTS}
    return replace(rows, **empty)


_PRODUCTS: Final = ("mii_g2", "moo_g2", "mpp_g2", "mio_g2", "mip_g2")
_VECTORS: Final = ("drive_{}", "lateral_{}", "g{}_g", "a{}_g", "f{}_hz", "phase_{}_deg")
_NUMBERS: Final = (
    *(name.format(axis) for name in _VECTORS for axis in AXES),
    "level_g",
    "main_rad_s",
    "sub_rad_s",
    "dwell_s",
)


def _columns(listed: Sequence[tuple[Mounting, Shake]]) -> dict[str, Any]:
    columns: dict[str, Any] = {"apparatus": np.array([each.apparatus for each, _ in listed])}
    for place, axis in enumerate(AXES):
        for name in ("drive", "lateral"):
            columns[f"{name}_{axis}"] = np.array([getattr(each, name)[place] for each, _ in listed])
        columns[f"g{axis}_g"] = np.array([each.gravity_g[place] for each, _ in listed])
        columns[f"a{axis}_g"] = np.array([0.0 if shake.random else shake.peak_g[place] for _, shake in listed])
        columns[f"f{axis}_hz"] = np.array([0.0 if shake.random else shake.frequency_hz[place] for _, shake in listed])
        columns[f"phase_{axis}_deg"] = np.array([shake.phase_deg[place] for _, shake in listed])
    for name in ("level_g", "main_rad_s", "sub_rad_s"):
        columns[name] = np.array([getattr(shake, name) for _, shake in listed])
    return columns | _random_products(listed)


def _random_products(listed: Sequence[tuple[Mounting, Shake]]) -> dict[str, FloatArray]:
    ways = np.array([each.drive for each, _ in listed])
    square = np.array([shake.level_g**2 if shake.random else np.nan for _, shake in listed])
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2))
    return {
        name: square * ways[:, first] * ways[:, second] for name, (first, second) in zip(_PRODUCTS, pairs, strict=True)
    }


def _along(drive: tuple[float, float, float], level_g: float, frequency_hz: float) -> Shake:
    """A sine along a direction of the unit."""
    i, o, p = (abs(part) * level_g for part in drive)
    phase_i, phase_o, phase_p = (180.0 if part < 0 else 0.0 for part in drive)
    moved = _of_axes({place: frequency_hz for place in range(3) if drive[place]})
    return Shake(level_g=level_g, peak_g=(i, o, p), frequency_hz=moved, phase_deg=(phase_i, phase_o, phase_p))


def shaken(
    drive: tuple[float, float, float],
    lateral: tuple[float, float, float],
    gravity_g: tuple[float, float, float] = (0.0, 1.0, 0.0),
) -> Mounting:
    """A shaker along a direction of the unit: every level twice, each time at another frequency."""
    shakes = tuple(_along(drive, level, _OCTAVES[place % len(_OCTAVES)]) for place, level in enumerate(2 * _LEVELS_G))
    return Mounting(drive=drive, lateral=lateral, gravity_g=gravity_g, shakes=shakes)


def _each(
    drive: tuple[float, float, float], lateral: tuple[float, float, float], make: Callable[[int], Shake], count: int
) -> Mounting:
    return Mounting(drive=drive, lateral=lateral, shakes=tuple(make(place) for place in range(count)))


_I: Final = (1.0, 0.0, 0.0)
_O: Final = (0.0, 1.0, 0.0)
_P: Final = (0.0, 0.0, 1.0)


def _frequencies() -> Mounting:
    return _each(_I, _O, lambda place: _along(_I, 6.0, 20.0 * 2.0 ** (place % 6)), 12)


def _random_beside() -> Mounting:
    def shake(place: int) -> Shake:
        level = _LEVELS_G[place // 2 % len(_LEVELS_G)]
        return Shake(level_g=level * _HALF, random=True) if place % 2 else _along(_I, level, 80.0)

    return _each(_I, _O, shake, 10)


def _upside(input_up: float) -> Mounting:
    """The input axis along gravity, and against it."""
    return shaken(_I, _O, (input_up, 0.0, 0.0))


def circle(up: int) -> Mounting:
    """A double centrifuge with one axis up, in both senses."""
    turning = [place for place in range(3) if place != up]
    shakes = []
    for level in (1.0, 2.0, 3.0):
        for rate_hz in _RATES_HZ:
            shakes.append(
                Shake(
                    level_g=level,
                    peak_g=_of_axes(dict.fromkeys(turning, level)),
                    frequency_hz=_of_axes(dict.fromkeys(turning, abs(rate_hz))),
                    phase_deg=_of_axes({turning[1]: -90.0 * float(np.sign(rate_hz))}),
                    main_rad_s=float(np.sqrt(level * STANDARD_GRAVITY_M_S2 / _ARM_M)),
                    sub_rad_s=2.0 * np.pi * rate_hz,
                )
            )
    gravity = (float(up == 0), float(up == 1), float(up == 2))
    return Mounting(apparatus=DOUBLE_CENTRIFUGE, gravity_g=gravity, shakes=tuple(shakes))


def phased(frequencies_hz: tuple[float, float, float] = (80.0, 80.0, 80.0)) -> Mounting:
    """Three shakers: each alone, then the second and the third beside the first in six phases."""
    alone = [(place,) for place in range(3)]
    pairs = [(0, across) for across in (1, 2) for _ in range(6)]
    return Mounting(
        apparatus=MULTI_SHAKER,
        shakes=tuple(
            Shake(
                level_g=level,
                peak_g=_of_axes(dict.fromkeys(axes, level)),
                frequency_hz=_of_axes({axis: frequencies_hz[axis] for axis in axes}),
                phase_deg=_of_axes({axes[-1]: 60.0 * (number % 6)}),
            )
            for number, axes in enumerate([*alone, *pairs])
            for level in ((3.0, 6.0) if len(axes) == 1 else (5.0,))
        ),
    )


def _of_axes(values: Mapping[int, float]) -> tuple[float, float, float]:
    """A value for each of some axes, 0 for the others."""
    return values.get(0, 0.0), values.get(1, 0.0), values.get(2, 0.0)


PROBES: Final = (
    VibrationProbe(
        programme="vibration-turned",
        does=Message("turns the unit by 180° about its input axis, so that sideways motion changes its sign"),
        mountings=(shaken(_I, (0.0, -1.0, 0.0), (0.0, -1.0, 0.0)), shaken(_I, _P, (0.0, 0.0, 1.0))),
    ),
    VibrationProbe(
        programme="vibration-reversed",
        does=Message("reverses the input axis, so that what the table does changes its sign"),
        mountings=(shaken((-1.0, 0.0, 0.0), _O),),
    ),
    VibrationProbe(
        programme="vibration-frequencies",
        does=Message("takes one level at six frequencies, in octaves"),
        mountings=(_frequencies(),),
    ),
    VibrationProbe(
        programme="vibration-random",
        does=Message("takes random vibration beside sines, of which the fourth powers differ"),
        mountings=(_random_beside(),),
    ),
    VibrationProbe(
        programme="vibration-up-and-down",
        does=Message("puts the input axis along gravity and against it"),
        mountings=(_upside(1.0), _upside(-1.0)),
    ),
    VibrationProbe(
        programme="vibration-fixtures",
        does=Message("drives along i, o, p and, in fixtures of 45°, along io and ip"),
        mountings=(
            shaken(_I, _O),
            shaken(_O, _I, (0.0, 0.0, 1.0)),
            shaken(_P, _I),
            shaken((_HALF, _HALF, 0.0), (_HALF, -_HALF, 0.0), (0.0, 0.0, 1.0)),
            shaken((_HALF, 0.0, _HALF), (_HALF, 0.0, -_HALF)),
        ),
    ),
    VibrationProbe(
        programme="vibration-centrifuge",
        does=Message("turns in both senses, with each axis up in turn"),
        mountings=tuple(circle(up) for up in (1, 0, 2)),
    ),
    VibrationProbe(
        programme="vibration-phases",
        does=Message("varies the phase between two shakers of one frequency"),
        mountings=(phased(),),
    ),
)
"""Programmes that come along with the stand; each a run of its own."""


def probes(step_s: float = STEP_S) -> tuple[VibrationProbe, ...]:
    """All of them, with the time from dwell to dwell."""
    return tuple(replace(probe, step_s=step_s) for probe in PROBES)


def usual_step_s(rows: VibrationObservations) -> float:
    """Time from dwell to dwell in a table."""
    if rows.time_s is None or len(rows) < 2:
        return STEP_S
    return max(float(np.median(np.diff(rows.time_s))), 1e-3)
