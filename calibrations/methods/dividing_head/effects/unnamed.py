"""On what structure without a name may depend in the table of an accelerometer: channels, and variables for each.

A scale that follows ax, or an angle that follows it, is an offset that does: those pairs are left out. Jumps of the
offset between realisations and of the angle between mountings have names. What the head does after moves in one
direction alone is a reversal error of each position; where it is the same everywhere, it is play and has a name.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.common_coordinates import pose_of, shown_in_seconds, temperature_of, time_of
from tumble.calibrations.tracing.components import Axis, Channel, axes
from tumble.calibrations.tracing.coordinate import MOST_VALUES, Coordinate
from tumble.messages import Message

_SMOOTHED: Final = 8
"""Degree of the polynomial in time from which the rate of the temperature is taken."""


_REMEMBERED_S: Final[Mapping[float, Message]] = {
    60.0: Message("that follows ax of the last 60 s"),
    100.0: Message("that follows ax of the last 100 s"),
    160.0: Message("that follows ax of the last 160 s"),
    260.0: Message("that follows ax of the last 260 s"),
}
"""For how long a spring that creeps remembers: what lasts between two of them looks much like the nearer one."""

_DRIFTS: Final = (("offset", "time"), ("offset", "temperature"))
"""A bias that drifts, or follows the temperature, is commoner than all the others."""


def unnamed(scene: Scene) -> tuple[Axis, ...]:
    """Everything along which a table could show structure without a name."""
    angle, response = tuple(_of_the_head(scene)), tuple(_of_the_input(scene))
    passing = (*_of_the_time(scene), *_of_the_warmth(scene), *_of_the_order(scene))
    offset = Channel(word="offset", gain=np.ones(scene.rows), phrase=Message("an offset of the output"), unit="V")
    scale = Channel(word="scale", gain=scene.ax_g, phrase=Message("a change of the response to ax"), unit="V/g")
    error = Channel(word="angle", gain=scene.slope_v_per_deg, phrase=Message("an error of the angle"), unit="deg")
    product_g2 = scene.gravity_g[:, 0] * scene.gravity_g[:, 1]
    reversal = Channel(
        word="angle",
        detail="reversal",
        gain=scene.slope_v_per_deg * (scene.direction < 0),
        phrase=Message("an error of the angle after moves in the negative direction"),
        unit="deg",
    )
    cross = Channel(word="cross", gain=product_g2, phrase=Message("a change of the response to ax·ay"), unit="V/g²")
    changing = (*_of_the_time(scene), *_of_the_warmth(scene))
    return axes(
        (error, (*angle, *passing)),
        (reversal, angle if len(np.unique(scene.direction)) > 1 else ()),
        (offset, (*response, *_of_the_input_lately(scene), *angle, *passing)),
        (scale, passing),
        (cross, changing),
        expected=_DRIFTS,
    )


def _of_the_head(scene: Scene) -> Iterator[Coordinate]:
    turned_deg = scene.angle_deg % 360.0
    yield Coordinate(
        word="angle",
        depends_on="angle",
        values=turned_deg,
        period=360.0,
        shown=_degrees,
        bumps=True,
        steps=True,
        overtones=True,
        phrase=Message("that follows the angle of the head"),
        unit="deg",
    )
    if np.ptp(scene.angle_deg) > 360.0:
        yield Coordinate(
            word="unwrapped_angle",
            depends_on="angle",
            values=scene.angle_deg,
            shown=_degrees,
            waves=True,
            overtones=True,
            phrase=Message("that follows the angle of the head over all turns"),
            unit="deg",
        )


def _of_the_input(scene: Scene) -> Iterator[Coordinate]:
    for axis, name in enumerate("xyz"):
        yield Coordinate(
            word="acceleration",
            depends_on="acceleration",
            values=scene.gravity_g[:, axis],
            shown="{:.2f} g".format,
            kinks=True,
            bumps=True,
            phrase=Message("that follows a{axis}", axis=name),
            detail=f"a{name}",
            unit="g",
        )
    yield pose_of(scene.gravity_g)


def _of_the_input_lately(scene: Scene) -> Iterator[Coordinate]:
    """What acted on a spring that creeps, less what acts now, which is part of the scale factor."""
    if scene.hours is None:
        return
    for lasting_s, phrase in _REMEMBERED_S.items():
        yield Coordinate(
            word="acceleration",
            depends_on="acceleration",
            values=_remembered(scene.ax_g, scene.hours * 3600.0, lasting_s) - scene.ax_g,
            shown="{:.2f} g".format,
            phrase=phrase,
            detail=f"ax of the last {lasting_s:g} s",
            unit="g",
        )


def _remembered(values: FloatArray, time_s: FloatArray, lasting_s: float) -> FloatArray:
    """Mean of what acted up to each row, what is older by `lasting_s` weighing less by e, shape (rows,).

    The head moves first and stands then: the time between two rows is that of the second.
    """
    kept = np.exp(-np.diff(time_s, prepend=time_s[0]) / lasting_s)
    remembered, now = np.empty_like(values), values[0]
    for row, value in enumerate(values):
        now = kept[row] * now + (1.0 - kept[row]) * value
        remembered[row] = now
    return remembered


def _of_the_time(scene: Scene) -> Iterator[Coordinate]:
    if scene.hours is not None:
        yield time_of(scene.hours)
        yield Coordinate(
            word="time_since_seating",
            depends_on="time",
            values=_since(scene.mounting, scene.hours),
            shown=shown_in_seconds,
            phrase=Message("that follows the time since the unit was seated"),
            unit="h",
        )


def _of_the_warmth(scene: Scene) -> Iterator[Coordinate]:
    if scene.temperature_k is None or not np.ptp(scene.temperature_k):
        return
    yield replace(temperature_of(scene.temperature_k + scene.reference_temperature_degc), steps=True)
    if scene.hours is not None and np.ptp(scene.hours):
        smooth = np.polynomial.Polynomial.fit(scene.hours, scene.temperature_k, min(_SMOOTHED, scene.rows // 20 + 1))
        yield Coordinate(
            word="temperature",
            depends_on="temperature",
            values=np.asarray(smooth.deriv()(scene.hours)),
            phrase=Message("that follows how fast the temperature changes"),
            detail="rate",
            unit="K/h",
        )


def _of_the_order(scene: Scene) -> Iterator[Coordinate]:
    count = np.arange(scene.rows, dtype=float)
    place = _since(scene.realisation, count)
    yield Coordinate(
        word="order",
        depends_on="order",
        values=place,
        waves=True,
        overtones=place.max() >= MOST_VALUES,  # with few dwells it would follow their settings, one after the other
        phrase=Message("that follows the number of dwells in the realisation"),
        detail="in the realisation",
    )
    if scene.hours is None:
        yield Coordinate(
            word="order",
            depends_on="order",
            values=count,
            phrase=Message("that follows the number of dwells in the table"),
            detail="in the table",
        )
    yield Coordinate(
        word="direction",
        depends_on="direction",
        values=scene.direction.astype(float),
        ordered=False,
        phrase=Message("that follows the direction of the last move"),
        detail="sign",
    )
    yield Coordinate(
        word="direction",
        depends_on="direction",
        values=_last_move_deg(scene),
        phrase=Message("that follows the size of the last move"),
        detail="size",
        unit="deg",
    )
    yield Coordinate(
        word="direction",
        depends_on="direction",
        values=_since_reversal(scene),
        phrase=Message("that follows the number of dwells since the last reversal"),
        detail="since reversal",
    )
    yield Coordinate(
        word="order",
        depends_on="order",
        values=count % 2.0,
        ordered=False,
        phrase=Message("that differs from every dwell to the next"),
        detail="parity",
    )
    yield Coordinate(
        word="realisation",
        depends_on="realisation",
        values=scene.realisation.astype(float),
        ordered=False,
        phrase=Message("that differs between realisations"),
        recurs=False,
    )


def _last_move_deg(scene: Scene) -> FloatArray:
    """Signed; none where the unit was seated anew."""
    moved_deg = np.diff(scene.angle_deg, prepend=scene.angle_deg[0])
    return np.asarray(np.where(np.diff(scene.mounting, prepend=-1) != 0, 0.0, moved_deg))


def _since_reversal(scene: Scene) -> FloatArray:
    """Dwells since the head turned round, negative in - direction; the first of them is 1."""
    count, reversed_ = np.arange(scene.rows), np.diff(scene.direction, prepend=0) != 0
    since = count - np.maximum.accumulate(np.where(reversed_, count, 0)) + 1
    return np.asarray(scene.direction * since, dtype=float)


def _degrees(angle_deg: float) -> str:
    return f"{angle_deg:.0f}°"


def _since(group: NDArray[np.int64], values: FloatArray) -> FloatArray:
    """Values less the first one of each unbroken run of a group."""
    run = np.cumsum(np.diff(labels(group), prepend=-1) != 0) - 1
    first = np.unique(run, return_index=True)[1]
    return np.asarray(values - values[first][run])
