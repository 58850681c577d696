"""Programmes of dwells: shakers in several mountings, centrifuges, several shakers, random beside sine."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Array = np.ndarray[Any, np.dtype[np.float64]]
_AXES = {"i": 0, "o": 1, "p": 2}


@dataclass
class Dwell:
    """One dwell as it is commanded; vectors of shape (3,) in the unit, i o p."""

    apparatus: str
    mounting: int
    realisation: int
    gravity_g: Array
    level_g: float = 0.0
    frequency_hz: Array = field(default_factory=lambda: np.zeros(3))
    peak_g: Array = field(default_factory=lambda: np.zeros(3))
    phase_rad: Array = field(default_factory=lambda: np.zeros(3))
    drive: Array = field(default_factory=lambda: np.zeros(3))
    lateral: Array = field(default_factory=lambda: np.zeros(3))
    main_rad_s: float = 0.0
    sub_rad_s: float = 0.0
    random: bool = False


def _unit(*parts: float) -> Array:
    vector = np.array(parts, dtype=float)
    return vector / np.linalg.norm(vector)


I, O, P = np.eye(3)  # noqa: E741  # the axes of the standard
_FIXTURES = (
    (I, O, O),
    (I, -O, -O),
    (I, P, P),
    (-I, O, P),
    (O, I, P),
    (P, I, O),
    (_unit(1, 1, 0), _unit(1, -1, 0), P),
    (_unit(1, 0, 1), _unit(1, 0, -1), O),
)
"""Drive, sideways axis of the table, and gravity of eight mountings; gravity is across the drive."""


def shaker(
    rng: np.random.Generator, fixtures: Sequence[int], passes: int, levels: Sequence[float], random: bool = False
) -> Iterator[Dwell]:
    """Rest between any two dwells under vibration, in several mountings, one after the other."""
    nominal = (30.0, 55.0, 110.0, 240.0)
    for realisation in range(1, passes + 1):
        for number, fixture in enumerate(fixtures, start=1):
            drive, lateral, gravity = _FIXTURES[fixture]
            common = {"apparatus": "shaker", "mounting": number, "realisation": realisation}
            common |= {"gravity_g": gravity, "drive": drive, "lateral": lateral}
            yield Dwell(**common)
            for place in range(2 * len(levels)):
                level = float(levels[place % len(levels)])
                frequency = nominal[(place // len(levels) + 2 * ((realisation + number) % 2)) % 4]
                frequency *= 1.0 + rng.normal(0.0, 0.001)
                noisy = random and place % 2 == 1
                moved = np.abs(drive) > 0
                yield Dwell(
                    **common,
                    level_g=level / np.sqrt(2.0) if noisy else level,
                    frequency_hz=np.where(moved, frequency, 0.0) * (not noisy),
                    peak_g=np.abs(drive) * level * (not noisy),
                    phase_rad=np.where(drive < 0, np.pi, 0.0) * moved + rng.uniform(-np.pi, np.pi) * moved,
                    random=noisy,
                )
                yield Dwell(**common)


def centrifuge(rng: np.random.Generator, up: str, passes: int, repeats: int = 1) -> Iterator[Dwell]:
    """Two equal sines 90° apart across the axis that is up, at several rates in both senses."""
    radius_m = 0.42
    for realisation in range(1, passes + 1):
        for number, axis in enumerate(up, start=1):
            gravity = np.eye(3)[_AXES[axis]]
            turning = [place for place in range(3) if place != _AXES[axis]]
            common = {"apparatus": "double-centrifuge", "mounting": number, "realisation": realisation}
            common |= {"gravity_g": gravity}
            yield Dwell(**common)
            for level in (1.5, 3.0, 5.0) * repeats:
                main = float(np.sqrt(level * 9.80665 / radius_m))
                for rate_hz in (1.5, -3.0, 6.0, -7.5):
                    phase = rng.uniform(-np.pi, np.pi)
                    frequency, peak, phases = np.zeros(3), np.zeros(3), np.zeros(3)
                    frequency[turning], peak[turning] = abs(rate_hz), level
                    phases[turning] = phase, phase - np.sign(rate_hz) * np.pi / 2
                    yield Dwell(
                        **common,
                        level_g=level,
                        frequency_hz=frequency,
                        peak_g=peak,
                        phase_rad=phases,
                        main_rad_s=main,
                        sub_rad_s=2.0 * np.pi * rate_hz,
                    )
                    yield Dwell(**common)


def shakers(rng: np.random.Generator, passes: int) -> Iterator[Dwell]:
    """Three shakers: each alone, two and three together, in phases that vary; every level comes at every frequency."""
    together = ("i", "o", "p", "i", "io", "io", "io", "ip", "ip", "ip", "iop", "i", "o", "p", "iop", "i")
    for realisation in range(1, passes + 1):
        common = {"apparatus": "multi-shaker", "mounting": 1, "realisation": realisation, "gravity_g": -O}
        yield Dwell(**common)
        for place, axes in enumerate(together):
            level = (2.5, 5.0, 7.5)[(place + realisation) % 3]
            base = rng.uniform(-np.pi, np.pi)
            frequency, peak, phase = np.zeros(3), np.zeros(3), np.zeros(3)
            for order, axis in enumerate(axes):
                unequal = axes == "iop" and place % 2
                frequency[_AXES[axis]] = (50.0, 100.0, 200.0)[(place + 2 * realisation) % 3] * (
                    1.0 + 0.37 * order * unequal
                )
                peak[_AXES[axis]] = level * (1.0 if order == 0 else 0.8)
                phase[_AXES[axis]] = base + order * np.deg2rad(60.0 * place)
            yield Dwell(**common, level_g=level, frequency_hz=frequency, peak_g=peak, phase_rad=phase)
            yield Dwell(**common)


DESIGNS = ("fixtures", "single", "turned", "centrifuge", "three-up", "multi", "mixed")


def design(name: str, rng: np.random.Generator) -> list[Dwell]:
    """The dwells of a programme."""
    made: dict[str, Callable[[], Iterator[Dwell]]] = {
        "fixtures": lambda: shaker(rng, range(8), 1, (1.5, 3.0, 5.0, 7.0, 9.0)),
        "single": lambda: shaker(rng, [0], 4, (1.5, 3.0, 5.0, 7.0, 9.0)),
        "turned": lambda: shaker(rng, [0, 1, 3], 2, (2.0, 4.0, 6.0, 8.0)),
        "centrifuge": lambda: centrifuge(rng, "o", 3),
        "three-up": lambda: centrifuge(rng, "oip", 2),
        "multi": lambda: shakers(rng, 3),
        "mixed": lambda: shaker(rng, [0, 4, 5, 6, 7], 2, (2.0, 5.0, 8.0), random=True),
    }
    return list(made[name]())
