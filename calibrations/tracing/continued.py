"""What a table may be noise in, in further rows: walks and levels go on, and so does structure without a name."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Axis, Component
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.calibrations.tracing.noise import Memory, NoiseModel, scaled_levels, slow_modes
from tumble.calibrations.tracing.shapes.jumping import sawtooth, square
from tumble.calibrations.tracing.shapes.onsets import onset, transient
from tumble.calibrations.tracing.shapes.overtones import overtones
from tumble.calibrations.tracing.shapes.places import levels
from tumble.calibrations.tracing.shapes.ramps import ramp
from tumble.calibrations.tracing.table import Extensible, View

_BENT: Final = 0.5
"""A bend goes on as a smooth course of this length, in ranges of the table: its polynomial would go anywhere."""
_HAPPENED: Final = np.array([0.3])
"""What happened once, beyond the values of the table goes on as a broken course of this length."""
_HAPPENS: Final = frozenset({"step", "pulse", "ramp", "onset", "transient", "changes"})
"""Shapes of what happened once."""
_COURSE: Final = {"wandering": "broken"}
"""Shapes of processes that go on as another one: a wandering that is pulled back is a broken course."""
_BEYOND: Final = 1.1
"""Further rows go beyond the values of the table where their range is so many times as long."""


def continued_noise(
    base: Extensible, noise: NoiseModel, components: Sequence[Component], scene: View, weights: FloatArray
) -> tuple[Memory, NoiseModel]:
    """Along what the rows of a table and further ones are correlated, and how much; a walk goes the further.

    The first rows of `scene` are those of the table.
    """
    if noise.walk and scene.hours is not None and base.scene.hours is not None:
        longer = float(np.ptp(scene.hours) / np.ptp(base.scene.hours))
        noise = replace(noise, walk=noise.walk * longer)
    names = [name for name, _ in noise.levels]
    levels = {
        effect.name: scaled_levels(effect.forms(scene)[0].columns, weights)
        for effect in base.effects
        if effect.name in names
    }
    axes = {axis.name: axis for axis in base.axes_in(scene)} if components else {}
    for each in components:
        columns = continued(each, axes.get(each.axis.name), scene.rows)
        known = columns[: base.rows] * np.sqrt(weights[: base.rows])[:, None]
        size = float(np.sqrt(np.mean(np.sum(known**2, axis=1))))
        levels[each.name] = columns * np.sqrt(weights)[:, None] / (size or 1.0)
    slow = scene.hours if noise.flicker or noise.walk else None
    return Memory(modes=slow_modes(slow, weights), levels=levels), noise


def continued(component: Component, axis: Axis | None, rows: int) -> FloatArray:
    """Columns of a component in more rows, along its axis there; nothing of it where there is no such axis."""
    if axis is None:
        return np.pad(component.columns, ((0, rows - len(component.columns)), (0, 0)))
    return np.asarray(_shape(component, axis.coordinate) * axis.channel.gain[:, None])


def _shape(component: Component, further: Coordinate) -> FloatArray:
    """The same for a channel of one."""
    own = component.axis.coordinate
    word, *numbers = component.shape.split()
    sizes = np.array(numbers, dtype=float)
    if word in _HAPPENS and further.range > _BEYOND * own.range:
        word, sizes = "broken", _HAPPENED
    if word in _SHAPES:
        return _SHAPES[word](own, further, sizes)
    kind, length = ("smooth", _BENT) if word == "bend" else (_COURSE.get(word, word), float(sizes[0]))
    return _course(kind, length, own, further)


def _part(own: Coordinate, further: Coordinate) -> FloatArray:
    """Where further rows are in the range of the table."""
    return np.asarray((further.values - own.low) / own.range)


def _part_of_cycle(own: Coordinate, further: Coordinate) -> FloatArray:
    """Where further rows are in the cycle of the table."""
    return np.asarray((further.values - own.low) / own.cycle)


def _wave(own: Coordinate, further: Coordinate, sizes: FloatArray) -> FloatArray:
    phase = 2.0 * np.pi * sizes[0] * _part(own, further)
    return np.column_stack([np.sin(phase), np.cos(phase)])


def _pulse(own: Coordinate, further: Coordinate, sizes: FloatArray) -> FloatArray:
    risen = levels(_part(own, further), sizes)
    return np.asarray(risen[:, :1] - risen[:, 1:])


_SHAPES: Final[Mapping[str, Callable[[Coordinate, Coordinate, FloatArray], FloatArray]]] = {
    "levels": lambda _, further, __: np.eye(int(further.bins.max()) + 1)[further.bins],
    "wave": _wave,
    "period": lambda own, further, sizes: overtones(
        _part_of_cycle(own, further), sizes[0] * np.arange(1.0, sizes[1] + 1.0)
    ),
    "square": lambda own, further, sizes: square(_part_of_cycle(own, further), sizes),
    "sawtooth": lambda own, further, sizes: sawtooth(_part_of_cycle(own, further), sizes),
    "bump": lambda _, further, sizes: np.column_stack(further.bells(sizes[None])),
    "spot": lambda _, further, sizes: further.spots(sizes[None]),
    "step": lambda own, further, sizes: levels(_part(own, further), sizes),
    "pulse": _pulse,
    "ramp": lambda own, further, sizes: ramp(_part(own, further), sizes),
    "onset": lambda own, further, sizes: onset(_part(own, further), sizes),
    "transient": lambda own, further, sizes: transient(_part(own, further), sizes[None]),
    "changes": lambda own, further, sizes: levels(_part(own, further), sizes),
}
"""Columns of shapes in further rows, for a channel of one, from the variable of the table and what fixes the shape."""


def _course(word: str, length: float, own: Coordinate, further: Coordinate) -> FloatArray:
    """Square root of the kernel of a process that is so many ranges of the table long, in each row."""
    away = _apart(further) / (length * float(_apart(own).max() if own.period is None else 1.0))
    kernel = np.exp(-away) if word == "broken" else np.exp(-0.5 * away**2)
    values, vectors = np.linalg.eigh(kernel)
    kept = values > 1e-3 * values[-1]
    return np.asarray((vectors[:, kept] * np.sqrt(values[kept]))[further.bins])


def _apart(coordinate: Coordinate) -> FloatArray:
    """Distances between bins, shape (bins, bins); round a circle, in halves of its circumference."""
    apart = coordinate.centres[:, None, :] - coordinate.centres[None, :, :]
    if coordinate.period is not None:
        return np.asarray(np.abs(np.sin(np.pi * apart[..., 0] / coordinate.period)))
    return np.asarray(np.linalg.norm(apart, axis=-1))
