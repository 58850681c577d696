"""On what structure without a name may depend in a table of vibrated dwells: channels, and variables for each."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.scene import VibrationScene
from tumble.calibrations.tracing.common_coordinates import temperature_of, time_of
from tumble.calibrations.tracing.components import Axis, Channel, axes
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.messages import Message

_OCTAVE: Final = 2.0


def unnamed(scene: VibrationScene) -> tuple[Axis, ...]:
    """Everything along which a table could show structure without a name."""
    level, frequency = _level(scene), _frequency(scene)
    slow = (*_of_the_time(scene), *_of_the_warmth(scene))
    offset = Channel(word="offset", gain=np.ones(scene.rows), phrase=Message("an offset of the output"), unit="µg")
    sine = scene.frequency_hz > 0.0
    moved = replace(
        offset, gain=(scene.power_g2 > 0.0).astype(float), phrase=Message("an offset under vibration"), detail="moved"
    )
    response = Channel(
        word="scale",
        gain=scene.products_g2[:, 0],
        phrase=Message("a change of the rectification along the input axis"),
        unit="µg/g²",
    )
    return axes(
        (offset, (level, *slow)),
        (moved, (level,)),
        (replace(moved, gain=sine.astype(float)), (frequency,)),
        (replace(response, gain=response.gain * sine), (frequency,)),
        (response, slow),
        expected=(("offset", "time"),),
    )


def _level(scene: VibrationScene) -> Coordinate:
    return Coordinate(
        word="amplitude",
        depends_on="amplitude",
        values=scene.level_g,
        shown="{:.2f} g".format,
        kinks=True,
        bumps=True,
        steps=True,
        phrase=Message("that follows the level of the vibration"),
        unit="g",
    )


def _frequency(scene: VibrationScene) -> Coordinate:
    return Coordinate(
        word="frequency",
        depends_on="frequency",
        values=_octaves(scene.frequency_hz),
        shown=lambda octaves: f"{_OCTAVE**octaves:.0f} Hz",
        bumps=True,
        steps=True,
        phrase=Message("that follows the frequency of the vibration"),
        unit="oct",
    )


def _octaves(frequency_hz: FloatArray) -> FloatArray:
    """Above 1 Hz; of dwells without one, which the channels leave out, that of the lowest."""
    moved = frequency_hz > 0.0
    lowest = float(frequency_hz[moved].min()) if moved.any() else 1.0
    return np.asarray(np.log2(np.where(moved, frequency_hz, lowest)))


def _of_the_time(scene: VibrationScene) -> Iterator[Coordinate]:
    if scene.hours is not None:
        yield time_of(scene.hours)


def _of_the_warmth(scene: VibrationScene) -> Iterator[Coordinate]:
    if scene.temperature_k is not None and np.ptp(scene.temperature_k):
        yield temperature_of(scene.temperature_k + scene.reference_temperature_degc)
