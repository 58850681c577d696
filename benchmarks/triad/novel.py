"""Forms that no catalogue has, drawn at random: channel or axis, place, width, period, phase.

Each is a function of one variable. What a run lasts and how warm it gets is taken from its dwells.
"""

from collections.abc import Callable, Mapping

import numpy as np

from benchmarks.triad.world import Array, Dwells, Stand, Unit

Draw = Callable[[np.random.Generator], Unit | Stand]
"""From a generator to a form, which is fixed then but for its size."""
_Course = Callable[[Array], Array]
"""From values of a variable, shape (dwells,), to what the channel does, shape (dwells,)."""
_Values = Callable[[Dwells, Array], Array]
"""A variable of the dwells, from them and gravity in one channel's axis."""


def _input(_: Dwells, felt_g: Array) -> Array:
    return felt_g


def _time(dwells: Dwells, _: Array) -> Array:
    """As a part of the run."""
    return (dwells.time_s - dwells.time_s[0]) / (dwells.time_s[-1] - dwells.time_s[0])


def _warmth(dwells: Dwells, _: Array) -> Array:
    """As a part of the range of the temperature."""
    kelvin = dwells.temperature_k[:, 0]
    return (kelvin - kelvin.min()) / np.ptp(kelvin)


def _along(variable: _Values, course: Callable[[np.random.Generator], _Course], *, response: bool = False) -> Draw:
    """Adds a course along a variable to one channel, or to its response."""

    def draw(rng: np.random.Generator) -> Unit:
        channel, drawn = int(rng.integers(3)), course(rng)

        def add(dwells: Dwells, gravity: Array, _: Array, size: float) -> Array:
            felt_g = gravity[:, channel]
            out = np.zeros((len(gravity), 3))
            out[:, channel] = size * drawn(variable(dwells, felt_g)) * (felt_g if response else 1.0)
            return out

        return add

    return draw


def _saturation(rng: np.random.Generator) -> _Course:
    knee = rng.uniform(0.6, 0.9)
    return lambda a: -np.sign(a) * np.maximum(np.abs(a) - knee, 0.0)


def _one_sided(rng: np.random.Generator) -> _Course:
    knee, sign = rng.uniform(0.2, 0.6), rng.choice([-1.0, 1.0])
    return lambda a: np.maximum(sign * a - knee, 0.0)


def _dead_zone(rng: np.random.Generator) -> _Course:
    width = rng.uniform(0.1, 0.25)
    return lambda a: -a * np.exp(-((a / width) ** 2))


def _fifth_order(_: np.random.Generator) -> _Course:
    return lambda a: 16.0 * a**5 - 20.0 * a**3 + 5.0 * a


def _resonance(rng: np.random.Generator) -> _Course:
    centre, width = rng.uniform(-0.75, 0.75), rng.uniform(0.1, 0.25)
    return lambda a: np.exp(-0.5 * ((a - centre) / width) ** 2)


def _logarithm(rng: np.random.Generator) -> _Course:
    early = rng.uniform(0.02, 0.15)
    return lambda part: np.log1p(part / early)


def _jump(rng: np.random.Generator) -> _Course:
    place = rng.uniform(0.25, 0.75)
    return lambda part: (part > place).astype(float)


def _wave(rng: np.random.Generator) -> _Course:
    turns, phase = rng.uniform(2.0, 8.0), rng.uniform(0.0, 2.0 * np.pi)
    return lambda part: np.sin(2.0 * np.pi * turns * part + phase)


def _saw_tooth(rng: np.random.Generator) -> _Course:
    turns, phase = rng.uniform(2.0, 6.0), rng.uniform()
    return lambda part: (turns * part + phase) % 1.0 - 0.5


def _bent(_: np.random.Generator) -> _Course:
    return lambda part: (2.0 * part - 1.0) ** 2


def _onset(rng: np.random.Generator) -> _Course:
    place, lasting = rng.uniform(0.3, 0.7), rng.uniform(0.03, 0.15)
    return lambda part: np.where(part > place, 1.0 - np.exp(-np.maximum(part - place, 0.0) / lasting), 0.0)


def _turning_point(rng: np.random.Generator) -> _Course:
    place = rng.uniform(0.35, 0.65)
    return lambda part: (part - place) ** 2


def _threshold(rng: np.random.Generator) -> _Course:
    place = rng.uniform(0.3, 0.7)
    return lambda part: np.tanh((part - place) / 0.05)


def _after_moves(*, response: bool) -> Draw:
    """Another bias, or response, of one channel after - moves of one axis."""

    def draw(rng: np.random.Generator) -> Unit:
        channel, outer = int(rng.integers(3)), bool(rng.integers(2))

        def add(dwells: Dwells, gravity: Array, _: Array, size: float) -> Array:
            after = (dwells.outer_direction if outer else dwells.inner_direction) < 0
            out = np.zeros((len(gravity), 3))
            out[:, channel] = size * after * (gravity[:, channel] if response else 1.0)
            return out

        return add

    return draw


def _odd_realisation(rng: np.random.Generator) -> Unit:
    channel, odd = int(rng.integers(3)), int(rng.integers(1, 4))

    def add(dwells: Dwells, gravity: Array, _: Array, size: float) -> Array:
        out = np.zeros((len(gravity), 3))
        out[:, channel] = size * gravity[:, channel] * (dwells.realisation == odd)
        return out

    return add


def _of_angle(course: Callable[[np.random.Generator], _Course]) -> Draw:
    """An error of one axis along its angle, in arc seconds."""

    def draw(rng: np.random.Generator) -> Stand:
        outer, drawn = bool(rng.integers(2)), course(rng)

        def change(dwells: Dwells, size: float) -> None:
            if outer:
                dwells.outer_error = dwells.outer_error + size * drawn(dwells.outer_deg)
            else:
                dwells.inner_error = dwells.inner_error + size * drawn(dwells.inner_deg)

        return change

    return draw


def _third_harmonic(rng: np.random.Generator) -> _Course:
    phase = rng.uniform(0.0, 2.0 * np.pi)
    return lambda angle_deg: np.sin(3.0 * np.deg2rad(angle_deg) + phase)


def _bump(rng: np.random.Generator) -> _Course:
    """At one of the angles that both axes take in every programme."""
    centre, width = 45.0 * float(rng.integers(8)), rng.uniform(8.0, 25.0)
    return lambda angle_deg: np.exp(-0.5 * (((angle_deg - centre + 180.0) % 360.0 - 180.0) / width) ** 2)


NOVEL_UNIT: Mapping[str, tuple[Draw, str]] = {
    "saturation": (_along(_input, _saturation), "acceleration"),
    "one_sided": (_along(_input, _one_sided), "acceleration"),
    "dead_zone": (_along(_input, _dead_zone), "acceleration"),
    "quartic": (_along(_input, lambda _: lambda a: a**4), "acceleration"),
    "fifth_order": (_along(_input, _fifth_order), "acceleration"),
    "resonance": (_along(_input, _resonance), "acceleration"),
    "log_drift": (_along(_time, _logarithm), "time"),
    "jump": (_along(_time, _jump), "time"),
    "wave": (_along(_time, _wave), "time"),
    "saw_tooth": (_along(_time, _saw_tooth), "time"),
    "bent_drift": (_along(_time, _bent), "time"),
    "onset": (_along(_time, _onset), "time"),
    "scale_jump": (_along(_time, _jump, response=True), "time"),
    "scale_wave": (_along(_time, _wave, response=True), "time"),
    "thermal_bend": (_along(_warmth, _turning_point), "temperature"),
    "thermal_threshold": (_along(_warmth, _threshold), "temperature"),
    "bias_after_move": (_after_moves(response=False), "direction"),
    "scale_after_move": (_after_moves(response=True), "direction"),
    "odd_realisation": (_odd_realisation, "realisation"),
}
"""Of the unit: how each is drawn, and the variable that it follows."""
NOVEL_STAND: Mapping[str, tuple[Draw, str]] = {
    "third_harmonic": (_of_angle(_third_harmonic), "angle"),
    "angle_bump": (_of_angle(_bump), "angle"),
}
"""Of the stand."""
