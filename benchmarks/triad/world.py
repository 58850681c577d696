"""A simulated triad on a two-axis stand: full rotation matrices, no line shared with the analysis.

Gravity is carried through the base, the outer axis, the arm and the inner axis by rotation matrices; effects act on the
true angles, on the vectors or on the outputs, wherever nature has them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

ARCSEC = np.pi / 180.0 / 3600.0
DWELL_S = 175.0
Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass
class Dwells:
    """What effects may change, dwell by dwell; all of it is there before they act."""

    outer_deg: Array
    inner_deg: Array
    time_s: Array
    realisation: Array
    outer_direction: Array
    inner_direction: Array
    temperature_k: Array
    """Above the reference, shape (dwells, 3)."""
    outer_error: Array = field(default_factory=lambda: np.zeros(0))
    """Of the angle, in arc seconds, shape (dwells,)."""
    inner_error: Array = field(default_factory=lambda: np.zeros(0))
    square: float = 0.0
    """By which the axes are not square, in arc seconds."""
    level_x: Array = field(default_factory=lambda: np.zeros(0))
    level_y: Array = field(default_factory=lambda: np.zeros(0))
    arm: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """Turn of the inner axis in the arm's frame, in arc seconds, shape (dwells, 3)."""

    def __post_init__(self) -> None:
        """Nothing is wrong yet."""
        count = len(self.outer_deg)
        self.outer_error, self.inner_error = np.zeros(count), np.zeros(count)
        self.level_x, self.level_y, self.arm = np.zeros(count), np.zeros(count), np.zeros((count, 3))

    def gravity(self) -> Array:
        """Gravity in the case, shape (dwells, 3)."""
        outer = np.deg2rad(self.outer_deg) + ARCSEC * (self.outer_error + self.level_x)
        inner = np.deg2rad(self.inner_deg) + ARCSEC * self.inner_error
        base = Rotation.from_euler("y", (ARCSEC * self.level_y)[:, None])
        arm = Rotation.from_rotvec(ARCSEC * self.arm)
        square = Rotation.from_euler("y", ARCSEC * self.square)
        whole = (
            base * Rotation.from_euler("x", outer[:, None]) * arm * square * Rotation.from_euler("z", inner[:, None])
        )
        return np.asarray(whole.inv().apply(np.array([0.0, 0.0, -1.0])))


Stand = Callable[[Dwells, float], None]
"""Changes dwells by an effect of a size."""
Unit = Callable[[Dwells, Array, Array, float], Array]
"""From dwells, gravity, ideal outputs in V and a size: what is added to the outputs, shape (dwells, 3)."""


@dataclass(frozen=True)
class Triad:
    """Parameters of a unit and its stand, in the terms of the contract."""

    bias_v: Array
    scale: Array
    """V/g."""
    m: Array
    """Arc seconds, zero diagonal, shape (3, 3)."""
    level_x: float
    level_y: float

    @property
    def stated(self) -> Mapping[str, float]:
        """By the names of the result."""
        pairs = [("x", "y"), ("x", "z"), ("y", "x"), ("y", "z"), ("z", "x"), ("z", "y")]
        return {
            **{f"bias_{c}": float(v) for c, v in zip("xyz", self.bias_v, strict=True)},
            **{f"scale_{c}": float(v) for c, v in zip("xyz", self.scale, strict=True)},
            **{f"m_{i}{j}": float(self.m["xyz".index(i), "xyz".index(j)]) for i, j in pairs},
            "level_x": self.level_x,
            "level_y": self.level_y,
        }


@dataclass(frozen=True)
class Made:
    """A table, and what went into it."""

    columns: Mapping[str, Array]
    triad: Triad
    noise_v: Array
    clean_v: Array
    """Outputs without effects and noise, shape (dwells, 3)."""
    effect_v: Array
    """What the effects add, shape (dwells, 3)."""


def draw_triad(rng: np.random.Generator) -> Triad:
    """A unit as they come: mV of bias, per cents of scale, hundreds of arc seconds."""
    m = rng.normal(0.0, 300.0, (3, 3))
    np.fill_diagonal(m, 0.0)
    return Triad(
        bias_v=rng.normal(0.0, 4e-3, 3),
        scale=1.0 + rng.normal(0.0, 0.02, 3),
        m=m,
        level_x=float(rng.normal(0.0, 40.0)),
        level_y=float(rng.normal(0.0, 40.0)),
    )


def make(
    rng: np.random.Generator,
    positions: Sequence[tuple[float, float]],
    passes: int,
    noise_v: Sequence[float],
    stand: Sequence[tuple[Stand, float]] = (),
    unit: Sequence[tuple[Unit, float]] = (),
    there_and_back: bool = True,
) -> Made:
    """A table of several passes of a list of positions, every second one backwards."""
    order = [
        list(positions) if number % 2 == 0 or not there_and_back else list(positions)[::-1] for number in range(passes)
    ]
    outer, inner = np.array([position for each in order for position in each]).T
    count = len(outer)
    time_s = DWELL_S * np.arange(1, count + 1)
    warming = 0.4 * (1 - np.exp(-time_s / time_s[-1] * 2)) + 0.15 * np.sin(time_s / 3000.0 + rng.uniform(0, 6))
    dwells = Dwells(
        outer_deg=outer,
        inner_deg=inner,
        time_s=time_s,
        realisation=np.repeat(np.arange(1, passes + 1), len(positions)),
        outer_direction=_direction(outer),
        inner_direction=_direction(inner),
        temperature_k=np.repeat(warming[:, None], 3, axis=1),
    )
    triad = draw_triad(rng)
    dwells.level_x += triad.level_x
    dwells.level_y += triad.level_y
    clean_v = _outputs(triad, dwells.gravity())
    for change, size in stand:
        change(dwells, size)
    gravity = dwells.gravity()
    ideal_v = _outputs(triad, gravity)
    outputs_v = ideal_v + sum((add(dwells, gravity, ideal_v, size) for add, size in unit), np.zeros((count, 3)))
    noise = np.array(noise_v)
    samples = 100
    measured = outputs_v + rng.normal(0.0, 1.0, (count, 3)) * noise
    scatter = noise * np.sqrt(samples) * np.sqrt(rng.chisquare(samples - 1, (count, 3)) / (samples - 1))
    columns = {
        "outer_deg": outer,
        "inner_deg": inner,
        **{f"u_{c}_V": measured[:, place] for place, c in enumerate("xyz")},
        "time_s": time_s,
        "realisation": dwells.realisation,
        "outer_direction": dwells.outer_direction,
        "inner_direction": dwells.inner_direction,
        "temperature_degC": 23.0 + warming,
        **{f"sd_{c}_V": scatter[:, place] for place, c in enumerate("xyz")},
        "samples": np.full(count, samples),
    }
    return Made(columns=columns, triad=triad, noise_v=noise, clean_v=clean_v, effect_v=outputs_v - clean_v)


def _outputs(triad: Triad, gravity: Array) -> Array:
    response = triad.scale[:, None] * (np.eye(3) + ARCSEC * triad.m)
    return np.asarray(triad.bias_v + gravity @ response.T)


def _direction(angle_deg: Array) -> Array:
    """Sign of the last move; the first position is reached from below."""
    step = np.sign(np.diff(angle_deg, prepend=angle_deg[0] - 1.0)).astype(int)
    for place in range(1, len(step)):
        if step[place] == 0:
            step[place] = step[place - 1]
    return step
