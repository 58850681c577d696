"""What an exciter makes a unit do: nothing, sines, random vibration, or turning in a double centrifuge.

Data, and the same as text, since it is a condition of dwells: `rest`, `sine 5 g 80 Hz`, `sine x 5 g 80 Hz 0 deg,
y 5 g 80 Hz 90 deg`, `random 20 Hz 0.001, 2000 Hz 0.001` (points of the spectral density in
g²/Hz), `rotation 10 -20` (rad/s).
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final, TypeAlias

from tumble.messages import Message

STANDARD_GRAVITY_M_S2: Final = 9.80665
RANDOM_PEAK: Final = 4.0
"""Peak of random vibration over its r.m.s. value that is counted with."""
_TONE: Final = re.compile(r"(?:(?P<shaker>[a-z]\w*) )?(?P<level>\S+) g (?P<hz>\S+) Hz(?: (?P<phase>\S+) deg)?")


@dataclass(frozen=True)
class Rest:
    """No drive."""

    @property
    def text(self) -> str:
        """The condition."""
        return "rest"

    def scaled(self, _fraction: float) -> "Rest":
        """The same."""
        return self


@dataclass(frozen=True, kw_only=True)
class Tone:
    """One shaker: `level_g sin(2π frequency_hz t + phase)`."""

    level_g: float
    """Peak."""
    frequency_hz: float
    phase_deg: float | None = None
    """Against the other shakers; None where there is only one."""
    shaker: str = ""
    """Its name; empty where there is only one."""

    @property
    def text(self) -> str:
        """A part of the condition."""
        phase = "" if self.phase_deg is None else f" {self.phase_deg:.9g} deg"
        return f"{self.shaker} {self.level_g:.9g} g {self.frequency_hz:.9g} Hz{phase}".strip()


@dataclass(frozen=True, kw_only=True)
class Sines:
    """One tone for each shaker that shakes."""

    tones: tuple[Tone, ...]

    @property
    def text(self) -> str:
        """The condition."""
        return f"sine {', '.join(tone.text for tone in self.tones)}"

    def scaled(self, fraction: float) -> "Sines":
        """With other levels."""
        return Sines(tones=tuple(replace(tone, level_g=fraction * tone.level_g) for tone in self.tones))


@dataclass(frozen=True, kw_only=True)
class Random:
    """Random vibration of a spectral density that goes straight between its points on logarithmic scales."""

    frequencies_hz: tuple[float, ...]
    density_g2_hz: tuple[float, ...]

    @property
    def text(self) -> str:
        """The condition."""
        points = zip(self.frequencies_hz, self.density_g2_hz, strict=True)
        return f"random {', '.join(f'{hz:.9g} Hz {density:.9g}' for hz, density in points)}"

    @property
    def rms_g(self) -> float:
        """Root of the integral of the density."""
        points = list(zip(self.frequencies_hz, self.density_g2_hz, strict=True))
        return math.sqrt(sum(_area_g2(low, high) for low, high in pairwise(points)))

    def scaled(self, fraction: float) -> "Random":
        """With another r.m.s. value."""
        return replace(self, density_g2_hz=tuple(fraction**2 * density for density in self.density_g2_hz))


@dataclass(frozen=True, kw_only=True)
class Rotation:
    """A double centrifuge: its arm turns, and on it a table that carries the unit."""

    main_rad_s: float
    sub_rad_s: float
    """Against the arm."""

    @property
    def text(self) -> str:
        """The condition."""
        return f"rotation {self.main_rad_s:.9g} {self.sub_rad_s:.9g}"

    def scaled(self, fraction: float) -> "Rotation":
        """With other rates."""
        return Rotation(main_rad_s=fraction * self.main_rad_s, sub_rad_s=fraction * self.sub_rad_s)


Excitation: TypeAlias = Rest | Sines | Random | Rotation
REST: Final = Rest()


def peak_g(excitation: Excitation, arm_m: float = 0.0) -> float:
    """Peak of the acceleration, in g; of random vibration four times its r.m.s. value."""
    match excitation:
        case Sines(tones=tones):
            return max(tone.level_g for tone in tones)
        case Random():
            return RANDOM_PEAK * excitation.rms_g
        case Rotation(main_rad_s=main_rad_s):
            return arm_m * main_rad_s**2 / STANDARD_GRAVITY_M_S2
        case _:
            return 0.0


def frequencies_hz(excitation: Excitation) -> tuple[float, ...]:
    """The frequencies at which the unit is shaken, or the ends of their band."""
    match excitation:
        case Sines(tones=tones):
            return tuple(tone.frequency_hz for tone in tones)
        case Random(frequencies_hz=points):
            return (points[0], points[-1])
        case Rotation(sub_rad_s=sub_rad_s):
            return (abs(sub_rad_s) / (2.0 * math.pi),)
        case _:
            return ()


def excitation_of(text: str) -> Excitation:
    """The excitation that a condition says. Raises `ValueError`."""
    kind, _, rest = text.partition(" ")
    parts = rest.split(", ") if rest else []
    try:
        match kind:
            case "rest" if not parts:
                return REST
            case "sine" if parts:
                return Sines(tones=tuple(map(_tone, parts)))
            case "random":
                points = [re.fullmatch(r"(\S+) Hz (\S+)", part) for part in parts]
                numbers = [tuple(map(float, point.groups())) for point in points if point]
                if len(numbers) == len(points) > 1:
                    return random_of(numbers)
            case "rotation":
                main_rad_s, sub_rad_s = map(float, rest.split())
                return Rotation(main_rad_s=main_rad_s, sub_rad_s=sub_rad_s)
    except ValueError:
        pass
    raise ValueError(Message("{text!r} is no excitation, such as rest, or sine 5 g 80 Hz", text=text))


def random_of(points: Sequence[Sequence[float]]) -> Random:
    """Random vibration of (Hz, g²/Hz) points, frequencies rising. Raises `ValueError`."""
    hz, density = [tuple(float(point[column]) for point in points) for column in (0, 1)]
    if len(points) < 2 or any(high <= low for low, high in pairwise(hz)) or min(*hz, *density) <= 0.0:
        raise ValueError(Message("a spectral density needs two points or more, positive, with rising frequencies"))
    return Random(frequencies_hz=hz, density_g2_hz=density)


def _tone(text: str) -> Tone:
    found = _TONE.fullmatch(text)
    if found is None:
        raise ValueError(text)
    phase = found["phase"]
    return Tone(
        shaker=found["shaker"] or "",
        level_g=float(found["level"]),
        frequency_hz=float(found["hz"]),
        phase_deg=None if phase is None else float(phase),
    )


def _area_g2(low: tuple[float, float], high: tuple[float, float]) -> float:
    """Integral of `G1 (f / f1)^n` between two points."""
    octaves = math.log(high[0] / low[0])
    power = math.log(high[1] / low[1]) / octaves + 1.0
    if abs(power * octaves) < 1e-9:
        return low[1] * low[0] * octaves
    return low[1] * low[0] * math.expm1(power * octaves) / power
