"""Effects that no catalogue names, each with the variable on which it depends (`depends_on` of result.md)."""

from collections.abc import Callable
from types import MappingProxyType
from typing import Final

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import AngleEffect, Effect, OutputEffect, Run, Scene
from benchmarks.bank.unit_effects import Draw, either_sign

Form = Callable[[Scene], FloatArray]


def added(name: str, draw_form: Callable[[np.random.Generator, Run], Form]) -> Draw:
    """An addition to the output that is its amplitude times a drawn form."""

    def draw(rng: np.random.Generator, run: Run) -> Effect:
        form = draw_form(rng, run)
        sign = either_sign(rng)
        return OutputEffect(name=name, sign=sign, added_v=lambda scene, amplitude: amplitude * form(scene))

    return draw


def misled(name: str, draw_error: Callable[[np.random.Generator, Run], FloatArray]) -> Draw:
    """An error of the angle that is its amplitude times a drawn course over the rows."""

    def draw(rng: np.random.Generator, run: Run) -> Effect:
        error = draw_error(rng, run)
        return AngleEffect(name=name, sign=either_sign(rng), error_deg=lambda _, amplitude: amplitude * error)

    return draw


def _from(angle_deg: FloatArray, centre_deg: float) -> FloatArray:
    """Angle from a centre, between -180° and 180°."""
    return (angle_deg - centre_deg + 180.0) % 360.0 - 180.0


def _bump(rng: np.random.Generator, run: Run) -> FloatArray:
    """A bruised tooth: the angle is wrong within some degrees of one place."""
    width_deg = rng.uniform(7.0, 18.0)
    return np.asarray(np.exp(-0.5 * (_from(run.dwells.angle_deg, rng.uniform(0.0, 360.0)) / width_deg) ** 2))


def _sector(rng: np.random.Generator, run: Run) -> FloatArray:
    """A ring that was cut in two: one sector is shifted as a whole."""
    return (np.abs(_from(run.dwells.angle_deg, rng.uniform(0.0, 360.0))) < rng.uniform(25.0, 60.0)).astype(float)


def _dead_zone(rng: np.random.Generator, _: Run) -> Form:
    width_g = rng.uniform(0.06, 0.2)
    return lambda scene: scene.gravity[:, 0] / width_g * np.exp(-0.5 * (scene.gravity[:, 0] / width_g) ** 2)


def _resonance(rng: np.random.Generator, _: Run) -> Form:
    """A bump of the output near one input."""
    centre_g, width_g = rng.uniform(-0.7, 0.7), rng.uniform(0.06, 0.2)
    return lambda scene: np.exp(-0.5 * ((scene.gravity[:, 0] - centre_g) / width_g) ** 2)


def _fifth_order(_: np.random.Generator, __: Run) -> Form:
    """Chebyshev's fifth polynomial of ax: a fifth order that no third order can stand in for."""
    return lambda scene: 16.0 * scene.gravity[:, 0] ** 5 - 20.0 * scene.gravity[:, 0] ** 3 + 5.0 * scene.gravity[:, 0]


def _air_conditioning(rng: np.random.Generator, run: Run) -> Form:
    """Periodic in time, 10 min to 30 min, from round to nearly square."""
    turn = 2.0 * np.pi * (run.dwells.elapsed_s / rng.uniform(600.0, 1800.0) + rng.uniform())
    steep = rng.uniform(0.5, 4.0)
    return lambda _: np.tanh(steep * np.sin(turn))


def _step_in_time(rng: np.random.Generator, run: Run) -> Form:
    """One step within a realisation, in the middle half of the run."""
    rows = len(run.dwells)
    first = int(rng.integers(rows // 4, 3 * rows // 4))
    while run.dwells.realisation[first] != run.dwells.realisation[min(first + 15, rows - 1)]:
        first -= 20
    step = (np.arange(rows) >= first).astype(float)
    return lambda _: step


def _bent_drift(_: np.random.Generator, run: Run) -> Form:
    """Quadratic drift without its linear part."""
    part = run.dwells.elapsed_s / run.dwells.elapsed_s[-1]
    return lambda _: (2.0 * part - 1.0) ** 2


def _turning_point(rng: np.random.Generator, run: Run) -> Form:
    """Bias with its extremum at a temperature in the middle of the ramp."""
    low, high = run.temperature_degc.min(), run.temperature_degc.max()
    centre = low + rng.uniform(0.35, 0.65) * (high - low)
    square = ((run.temperature_degc - centre) / (0.5 * (high - low))) ** 2
    return lambda _: square


def _threshold_of_warmth(rng: np.random.Generator, run: Run) -> Form:
    """A transition: the bias changes within a small part of the ramp."""
    low, high = run.temperature_degc.min(), run.temperature_degc.max()
    centre = low + rng.uniform(0.3, 0.7) * (high - low)
    step = np.tanh((run.temperature_degc - centre) / (0.04 * (high - low)))
    return lambda _: step


def _since_start(rng: np.random.Generator, run: Run) -> Form:
    """Every realisation begins afresh: dies out with the number of dwells since its start."""
    number = run.dwells.realisation
    place = np.arange(len(number)) - np.searchsorted(number, number)
    decay = np.exp(-place / rng.uniform(10.0, 40.0))
    return lambda _: decay


def _odd_realisation(rng: np.random.Generator, run: Run) -> Form:
    """One realisation with another scale factor."""
    odd = run.dwells.realisation == rng.integers(1, run.dwells.realisation[-1] + 1)
    return lambda scene: scene.gravity[:, 0] * odd


def _scale_after_move(_: np.random.Generator, run: Run) -> Form:
    """Another scale factor after - moves."""
    return lambda scene: scene.gravity[:, 0] * (run.dwells.direction < 0)


def _bias_after_move(_: np.random.Generator, run: Run) -> Form:
    """Another bias after - moves."""
    return lambda _: (run.dwells.direction < 0).astype(float)


NOVEL: Final = MappingProxyType(
    {
        "angle_bump": ("angle", 0.1, misled("angle_bump", _bump)),
        "angle_sector": ("angle", 0.1, misled("angle_sector", _sector)),
        "dead_zone": ("acceleration", 5e-3, added("dead_zone", _dead_zone)),
        "resonance": ("acceleration", 5e-3, added("resonance", _resonance)),
        "fifth_order": ("acceleration", 5e-3, added("fifth_order", _fifth_order)),
        "air_conditioning": ("time", 5e-3, added("air_conditioning", _air_conditioning)),
        "step_in_time": ("time", 5e-3, added("step_in_time", _step_in_time)),
        "bent_drift": ("time", 5e-3, added("bent_drift", _bent_drift)),
        "turning_point": ("temperature", 5e-3, added("turning_point", _turning_point)),
        "threshold_of_warmth": ("temperature", 5e-3, added("threshold_of_warmth", _threshold_of_warmth)),
        "since_start": ("order", 5e-3, added("since_start", _since_start)),
        "odd_realisation": ("realisation", 5e-3, added("odd_realisation", _odd_realisation)),
        "scale_after_move": ("direction", 5e-3, added("scale_after_move", _scale_after_move)),
        "bias_after_move": ("direction", 5e-3, added("bias_after_move", _bias_after_move)),
    }
)
"""For each kind: what it depends on, its largest amplitude (V or degrees), and how to draw it."""
