"""On what structure without a name may depend in the table of a gyrocompass: channels, and variables for each.

The rate has an offset and a response, the pickoff an error of its angle that rates and tilts follow, the base an
azimuth that the tilts do not. The tilt sensor has an offset of its own, lest what is wrong with it be looked for in
the rates.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.tracing.common_coordinates import temperature_of, time_of
from tumble.calibrations.tracing.components import Axis, Channel, axes
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.messages import Message

_Pair = tuple[Channel, tuple[Coordinate, ...]]


def unnamed(scene: GyrocompassScene) -> tuple[Axis, ...]:
    """Everything along which a table could show structure without a name."""
    return axes(*_pairs(scene), expected=(("offset", "time"), ("offset", "temperature")))


def _pairs(scene: GyrocompassScene) -> Iterator[_Pair]:
    passing = (*_of_the_time(scene), *_of_the_warmth(scene))
    angle = _of_the_angle(scene)
    yield _offset(scene), _in_rows(scene, (angle, _of_the_rate(scene), *passing))
    yield _scale(scene), _in_rows(scene, passing)
    pickoff, base = _angles(scene)
    yield pickoff, _in_rows(scene, (angle, *passing))
    yield base, _in_rows(scene, tuple(_of_the_time(scene)))
    if scene.with_tilts:
        yield _tilt(scene), _in_rows(scene, (angle, *passing))


def _offset(scene: GyrocompassScene) -> Channel:
    return Channel(
        word="offset",
        gain=scene.in_rows(np.ones(scene.dwells)),
        phrase=Message("an offset of the rate"),
        unit="°/h",
    )


def _scale(scene: GyrocompassScene) -> Channel:
    return Channel(
        word="scale",
        gain=scene.in_rows(scene.rate_deg_h),
        phrase=Message("a change of the torquer's response"),
        unit="fraction",
    )


def _angles(scene: GyrocompassScene) -> tuple[Channel, Channel]:
    ones = np.ones(scene.dwells)
    return (
        Channel(
            word="angle",
            detail="pickoff",
            gain=scene.turned(ones),
            phrase=Message("an error of the pickoff angle"),
            unit="rad",
        ),
        Channel(
            word="angle",
            detail="base",
            gain=scene.in_rows(scene.rate_slope),
            phrase=Message("a turn of the base"),
            unit="rad",
        ),
    )


def _tilt(scene: GyrocompassScene) -> Channel:
    nothing = np.zeros(scene.dwells)
    return Channel(
        word="offset",
        detail="tilt",
        gain=scene.in_rows(nothing, np.ones(scene.dwells)),
        phrase=Message("an offset of the tilt sensor"),
        unit="rad",
    )


def _in_rows(scene: GyrocompassScene, coordinates: tuple[Coordinate, ...]) -> tuple[Coordinate, ...]:
    """Variables of the dwells as those of the rows."""
    return tuple(
        replace(each, values=_repeated(each.values, scene.outputs), outputs=scene.outputs) for each in coordinates
    )


def _repeated(values: FloatArray, outputs: int) -> FloatArray:
    return np.repeat(values, outputs, axis=0)


def _of_the_angle(scene: GyrocompassScene) -> Coordinate:
    return Coordinate(
        word="angle",
        depends_on="angle",
        values=scene.observations.azimuth_deg % 360.0,
        period=360.0,
        shown="{:.0f}°".format,
        bumps=True,
        steps=True,
        overtones=True,
        phrase=Message("that follows the pickoff angle"),
        unit="deg",
    )


def _of_the_rate(scene: GyrocompassScene) -> Coordinate:
    return Coordinate(
        word="rate",
        depends_on="rate",
        values=scene.rate_deg_h,
        shown="{:.2f} °/h".format,
        kinks=True,
        bumps=True,
        phrase=Message("that follows the rate"),
        unit="°/h",
    )


def _of_the_time(scene: GyrocompassScene) -> Iterator[Coordinate]:
    if scene.dwell_hours is not None:
        yield time_of(scene.dwell_hours)
    else:
        yield Coordinate(
            word="order",
            depends_on="order",
            values=np.arange(scene.dwells, dtype=float),
            shown="{:.0f}".format,
            waves=True,
            steps=True,
            kinks=True,
            phrase=Message("that follows the order of the dwells"),
        )


def _of_the_warmth(scene: GyrocompassScene) -> Iterator[Coordinate]:
    if scene.temperature_k is not None and np.ptp(scene.temperature_k):
        yield temperature_of(scene.temperature_k + scene.reference_temperature_degc)
