"""From the angle of the head to the reading: the chain through which every effect of the bank acts."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from benchmarks.bank.dwells import Dwells
from benchmarks.bank.geometry import FloatArray, projections

SAMPLES = 100
"""Samples in a dwell."""


@dataclass(frozen=True, kw_only=True)
class Unit:
    """True parameters, as result.md refers to them."""

    u0: float
    kx: float
    ky: float
    kz: float
    kxy: float
    alpha0_deg: float

    def output_v(self, gravity: FloatArray) -> FloatArray:
        """Output of the declared model (seed 000, second paper, equation 1), in volts."""
        linear = gravity @ np.array([self.kx, self.ky, self.kz])
        return np.asarray(self.u0 + linear + self.kxy * gravity[:, 0] * gravity[:, 1])


def drawn_unit(rng: np.random.Generator) -> Unit:
    """Draw a unit like a DXL203EB."""
    return Unit(
        u0=2.5 + rng.normal(0.0, 0.03),
        kx=1.0 + rng.normal(0.0, 0.03),
        ky=rng.normal(0.0, 0.012),
        kz=rng.normal(0.0, 0.012),
        kxy=rng.normal(0.0, 0.001),
        alpha0_deg=rng.uniform(-0.6, 0.6),
    )


@dataclass(frozen=True, kw_only=True)
class Run:
    """A design together with what surrounded it: temperature and vibration of each row."""

    dwells: Dwells
    temperature_degc: FloatArray
    """True temperature."""
    expected_sd_v: FloatArray
    """Standard deviation that the samples of the dwell are drawn with."""
    measured_sd_v: FloatArray
    """Standard deviation that the samples of the dwell happened to have."""


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A run as the unit feels it: true angles and projections of gravity."""

    run: Run
    angle_deg: FloatArray
    """True angle, alpha0 and errors of the head included."""
    gravity: FloatArray
    """(ax, ay, az) of every row, in g."""


Value = float | int | list[int] | list[float]


@dataclass(frozen=True, kw_only=True)
class Effect:
    """A drawn effect: everything is fixed but its amplitude."""

    name: str
    shape: str = "pure"
    """Which of the bank's functional forms it takes."""
    sign: float = 1.0
    """Sign of the amplitude."""
    amplitude_key: str | None = None
    """Key of the amplitude among the coefficients; None where the amplitude is the only one."""
    others: Mapping[str, Value] = field(default_factory=dict)
    """The other coefficients, in the contract's keys and units."""

    def coefficient(self, amplitude: float) -> float | dict[str, Value]:
        """Return what effects.md calls the coefficients, for this amplitude."""
        return amplitude if self.amplitude_key is None else {self.amplitude_key: amplitude, **self.others}


@dataclass(frozen=True, kw_only=True)
class AngleEffect(Effect):
    """True angle minus the angle for which the head was sent, in degrees."""

    error_deg: Callable[[Run, float], FloatArray]


@dataclass(frozen=True, kw_only=True)
class TiltEffect(Effect):
    """The amplitude tilts the head's axis, in degrees, positive with the Z end down."""


@dataclass(frozen=True, kw_only=True)
class OutputEffect(Effect):
    """An addition to the unit's output, in volts."""

    added_v: Callable[[Scene, float], FloatArray]


@dataclass(frozen=True, kw_only=True)
class ReadingEffect(Effect):
    """Error of the instrument, in volts, from the voltages at its input and the amplitude."""

    error_v: Callable[[Run, FloatArray, float], FloatArray]


Sized = tuple[Effect, float]
"""An effect and its amplitude."""


def respond(run: Run, unit: Unit, sized: Sequence[Sized], noise_v: FloatArray | float = 0.0) -> FloatArray:
    """Return the reading of every row, in volts; the noise is the unit's and passes through the instrument."""
    angle_deg = run.dwells.angle_deg + unit.alpha0_deg
    tilt_deg = 0.0
    for effect, amplitude in sized:
        if isinstance(effect, AngleEffect):
            angle_deg = angle_deg + effect.error_deg(run, amplitude)
        elif isinstance(effect, TiltEffect):
            tilt_deg += amplitude
    scene = Scene(run=run, angle_deg=angle_deg, gravity=projections(run.dwells.axes, angle_deg, tilt_deg))
    output_v = unit.output_v(scene.gravity) + noise_v
    for effect, amplitude in sized:
        if isinstance(effect, OutputEffect):
            output_v = output_v + effect.added_v(scene, amplitude)
    for effect, amplitude in sized:
        if isinstance(effect, ReadingEffect):
            output_v = output_v + effect.error_v(run, output_v, amplitude)
    return output_v
