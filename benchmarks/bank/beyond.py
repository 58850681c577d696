"""A second set of effects that no catalogue names, in forms that no analysis was written for, by what they depend on.

They come from the mechanics, the electronics and the surroundings of a stand: worn gears, stops, sticking, saturation,
lag, hum, relays, creep. Each has one drawn form of amplitude one.
"""

from collections.abc import Callable
from types import MappingProxyType
from typing import Final

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.novel import Form, added, misled
from benchmarks.bank.scene import Run
from benchmarks.bank.unit_effects import Draw

Rng = np.random.Generator


def _worn_arc(rng: Rng, angle_deg: FloatArray) -> FloatArray:
    """Wear that grows towards the middle of an arc."""
    half_deg = rng.uniform(30.0, 60.0)
    away_deg = np.abs((angle_deg - rng.uniform(0.0, 360.0) + 180.0) % 360.0 - 180.0)
    return np.clip(1.0 - away_deg / half_deg, 0.0, None)


def _sawtooth(rng: Rng, angle_deg: FloatArray) -> FloatArray:
    """A worm that is turned back by its own spring once per turn of its own: a part of the circle, not whole."""
    period_deg = rng.uniform(38.0, 85.0)
    return ((angle_deg + rng.uniform(0.0, period_deg)) / period_deg) % 1.0 - 0.5


def _belt(rng: Rng, angle_deg: FloatArray) -> FloatArray:
    """A belt whose length is no part of a turn."""
    return np.asarray(np.sin(2.0 * np.pi * (angle_deg / rng.uniform(55.0, 250.0) + rng.uniform())))


def _teeth(rng: Rng, angle_deg: FloatArray) -> FloatArray:
    """Three broken teeth."""
    broken_deg = rng.uniform(0.0, 360.0, 3)
    return sum(
        ((np.abs((angle_deg - deg + 180.0) % 360.0 - 180.0) < 6.0).astype(float) for deg in broken_deg),
        np.zeros(len(angle_deg)),
    )


def _cam(rng: Rng, angle_deg: FloatArray) -> FloatArray:
    """A follower that lifts off: half a sine, cubed."""
    return np.clip(np.sin(np.deg2rad(angle_deg - rng.uniform(0.0, 360.0))), 0.0, None) ** 3


def _of_ax(form: Callable[[Rng, FloatArray], FloatArray], axis: int = 0) -> Callable[[Rng, Run], Form]:
    """A form of one projection of gravity, its drawn numbers the same in every scene."""

    def draw(rng: Rng, _: Run) -> Form:
        seed = int(rng.integers(2**31))
        return lambda scene: form(np.random.default_rng(seed), scene.gravity[:, axis])

    return draw


def _saturation(rng: Rng, ax_g: FloatArray) -> FloatArray:
    limit_g = rng.uniform(0.6, 0.85)
    return ax_g - np.clip(ax_g, -limit_g, limit_g)


def _one_stop(rng: Rng, ax_g: FloatArray) -> FloatArray:
    """A stop that is touched on one side only, and stiffens."""
    return np.clip(ax_g - rng.uniform(0.3, 0.7), 0.0, None) ** 1.5


def _stiction(rng: Rng, ax_g: FloatArray) -> FloatArray:
    """A mass that jumps from place to place."""
    step_g = rng.uniform(0.25, 0.5)
    return step_g * np.round(ax_g / step_g + rng.uniform(-0.3, 0.3)) - ax_g


def _dead_band(rng: Rng, ax_g: FloatArray) -> FloatArray:
    band_g = rng.uniform(0.08, 0.25)
    return -np.clip(ax_g, -band_g, band_g)


def _crossover(rng: Rng, ax_g: FloatArray) -> FloatArray:
    """An output stage that changes hands near zero."""
    return np.tanh((ax_g - rng.uniform(-0.2, 0.2)) / 0.03)


def _rectifier(rng: Rng, ay_g: FloatArray) -> FloatArray:
    return np.exp(rng.uniform(2.0, 4.0) * (ay_g - 1.0))


def _twisted_pose(_: Rng, __: Run) -> Form:
    """A suspension that twists: third order in two axes."""
    return lambda scene: scene.gravity[:, 0] ** 2 * scene.gravity[:, 1]


def _elapsed(form: Callable[[Rng, FloatArray], FloatArray], *, of_scale: bool = False) -> Callable[[Rng, Run], Form]:
    """A form of the seconds since the first row, added or as a change of the scale."""

    def draw(rng: Rng, run: Run) -> Form:
        values = form(rng, run.dwells.elapsed_s)
        return (lambda scene: values * scene.gravity[:, 0]) if of_scale else (lambda _: values)

    return draw


def _hum(rng: Rng, elapsed_s: FloatArray) -> FloatArray:
    """The mains beating with the dwell."""
    return np.asarray(np.sin(2.0 * np.pi * (elapsed_s / rng.uniform(70.0, 130.0) + rng.uniform())))


def _telegraph(rng: Rng, elapsed_s: FloatArray) -> FloatArray:
    """A relay that drops out a few times."""
    switched_s = np.sort(rng.uniform(0.0, elapsed_s[-1], rng.integers(3, 7)))
    return np.asarray(np.searchsorted(switched_s, elapsed_s) % 2, dtype=float)


def _pulse(rng: Rng, elapsed_s: FloatArray) -> FloatArray:
    part = elapsed_s / elapsed_s[-1]
    start = rng.uniform(0.1, 0.7)
    return ((part > start) & (part < start + rng.uniform(0.06, 0.2))).astype(float)


def _chirp(rng: Rng, elapsed_s: FloatArray) -> FloatArray:
    """A motor that runs up."""
    part = elapsed_s / elapsed_s[-1]
    return np.asarray(np.sin(2.0 * np.pi * (rng.uniform(2.0, 4.0) * part + rng.uniform(4.0, 9.0) * part**2)))


def _creep(rng: Rng, elapsed_s: FloatArray) -> FloatArray:
    """Rises late and steeply, as a battery near its end."""
    part = elapsed_s / elapsed_s[-1]
    return np.asarray(part ** rng.uniform(6.0, 12.0))


def _triangle(rng: Rng, elapsed_s: FloatArray) -> FloatArray:
    """A two-point thermostat."""
    turn = (elapsed_s / rng.uniform(700.0, 2200.0) + rng.uniform()) % 1.0
    return np.abs(4.0 * turn - 2.0) - 1.0


def _warmth(form: Callable[[Rng, FloatArray], FloatArray], *, of_scale: bool = False) -> Callable[[Rng, Run], Form]:
    """A form of the temperature in its range, from 0 to 1."""

    def draw(rng: Rng, run: Run) -> Form:
        low, high = run.temperature_degc.min(), run.temperature_degc.max()
        values = form(rng, (run.temperature_degc - low) / (high - low))
        return (lambda scene: values * scene.gravity[:, 0]) if of_scale else (lambda _: values)

    return draw


def _lag(rng: Rng, run: Run) -> Form:
    """A part that follows the temperature of the air late."""
    tau_s = rng.uniform(600.0, 1800.0)
    late = np.empty(len(run.dwells))
    late[0] = run.temperature_degc[0]
    step = 1.0 - np.exp(-np.diff(run.dwells.elapsed_s) / tau_s)
    for row, part in enumerate(step):
        late[row + 1] = late[row] + part * (run.temperature_degc[row + 1] - late[row])
    values = (late - run.temperature_degc) / np.ptp(run.temperature_degc)
    return lambda _: values


def _after_reversal(rng: Rng, run: Run) -> Form:
    """What is wound up at a reversal and lets go within some dwells."""
    values = run.dwells.direction * np.exp(
        -_dwells_since(np.diff(run.dwells.direction, prepend=0) != 0) / rng.uniform(3.0, 12.0)
    )
    return lambda _: values


def _after_move(_: Rng, run: Run) -> Form:
    """The larger the last move, the more: the support is twisted and takes a dwell to come back."""
    move_deg = np.abs(np.diff(run.dwells.angle_deg, prepend=run.dwells.angle_deg[0]))
    return lambda _: np.sqrt(move_deg / 90.0)


def _second_order_after_move(_: Rng, run: Run) -> Form:
    """A second order that is there after - moves only."""
    return lambda scene: scene.gravity[:, 0] ** 2 * (run.dwells.direction < 0)


def _tired(_: Rng, run: Run) -> Form:
    """Grows like the root of the number of dwells since the start of the realisation."""
    number = run.dwells.realisation
    place = np.arange(len(number)) - np.searchsorted(number, number)
    return lambda _: np.sqrt(place / place.max())


def _every_other(_: Rng, run: Run) -> Form:
    """A multiplexer that reads by turns through two inputs."""
    return lambda _: (np.arange(len(run.dwells)) % 2).astype(float)


def _relaxing_seat(rng: Rng, run: Run) -> FloatArray:
    """Every seating settles down: an angle that dies out with the time since."""
    first = np.searchsorted(run.dwells.mounting, run.dwells.mounting)
    return np.exp(-(run.dwells.elapsed_s - run.dwells.elapsed_s[first]) / rng.uniform(60.0, 200.0))


def _bias_since_seating(rng: Rng, run: Run) -> Form:
    first = np.searchsorted(run.dwells.mounting, run.dwells.mounting)
    since_s = run.dwells.elapsed_s - run.dwells.elapsed_s[first]
    values = np.log1p(since_s / rng.uniform(20.0, 80.0))
    return lambda _: values / values.max()


def _strained(rng: Rng, run: Run) -> Form:
    """One realisation with a second order of its own: the unit was strained."""
    odd = run.dwells.realisation == rng.integers(1, run.dwells.realisation[-1] + 1)
    return lambda scene: scene.gravity[:, 0] ** 2 * odd


def _by_turns(_: Rng, run: Run) -> Form:
    """Two power supplies by turns, each with its scale."""
    return lambda scene: scene.gravity[:, 0] * (run.dwells.realisation % 2)


def _slipped_base(rng: Rng, run: Run) -> FloatArray:
    """The base slips once, in the middle of a mounting."""
    mounting = run.dwells.mounting
    longest = np.flatnonzero(np.bincount(mounting) >= 20)
    rows = np.flatnonzero(mounting == rng.choice(longest[len(longest) // 4 : -len(longest) // 4 or None]))
    return (np.arange(len(mounting)) >= rows[len(rows) // 2]).astype(float)


def _dwells_since(begins: np.ndarray) -> FloatArray:
    count = np.arange(len(begins))
    return np.asarray(count - np.maximum.accumulate(np.where(begins, count, 0)), dtype=float)


def _head(form: Callable[[Rng, FloatArray], FloatArray]) -> Callable[[Rng, Run], FloatArray]:
    return lambda rng, run: form(rng, run.dwells.angle_deg)


_ANGLES: Final[dict[str, tuple[str, Callable[[Rng, Run], FloatArray]]]] = {
    "worn_arc": ("angle", _head(_worn_arc)),
    "sawtooth": ("angle", _head(_sawtooth)),
    "belt": ("angle", _head(_belt)),
    "teeth": ("angle", _head(_teeth)),
    "cam": ("angle", _head(_cam)),
    "relaxing_seat": ("time", _relaxing_seat),
    "slipped_base": ("time", _slipped_base),
}
_OUTPUTS: Final[dict[str, tuple[str, Callable[[Rng, Run], Form]]]] = {
    "saturation": ("acceleration", _of_ax(_saturation)),
    "one_stop": ("acceleration", _of_ax(_one_stop)),
    "stiction": ("acceleration", _of_ax(_stiction)),
    "dead_band": ("acceleration", _of_ax(_dead_band)),
    "crossover": ("acceleration", _of_ax(_crossover)),
    "rectifier": ("acceleration", _of_ax(_rectifier, axis=1)),
    "twisted_pose": ("acceleration", _twisted_pose),
    "hum": ("time", _elapsed(_hum)),
    "telegraph": ("time", _elapsed(_telegraph)),
    "pulse": ("time", _elapsed(_pulse)),
    "chirp": ("time", _elapsed(_chirp)),
    "creep": ("time", _elapsed(_creep)),
    "thermostat_of_scale": ("time", _elapsed(_triangle, of_scale=True)),
    "bias_since_seating": ("time", _bias_since_seating),
    "kink_of_warmth": ("temperature", _warmth(lambda rng, part: np.clip(part - rng.uniform(0.3, 0.7), 0.0, None))),
    "ripple_of_warmth": ("temperature", _warmth(lambda rng, part: np.sin(2 * np.pi * part * rng.uniform(1.5, 4.0)))),
    "bent_scale": ("temperature", _warmth(lambda _, part: (2.0 * part - 1.0) ** 2, of_scale=True)),
    "thermal_lag": ("temperature", _lag),
    "after_reversal": ("direction", _after_reversal),
    "after_move": ("direction", _after_move),
    "second_order_after_move": ("direction", _second_order_after_move),
    "tired": ("order", _tired),
    "every_other": ("order", _every_other),
    "strained": ("realisation", _strained),
    "by_turns": ("realisation", _by_turns),
}

BEYOND: Final = MappingProxyType[str, tuple[str, float, Draw]](
    {
        **{name: (on, 0.1, misled(name, draw)) for name, (on, draw) in _ANGLES.items()},
        **{name: (on, 5e-3, added(name, draw)) for name, (on, draw) in _OUTPUTS.items()},
    }
)
"""For each kind: what it depends on, its largest amplitude (V or degrees), and how to draw it."""
