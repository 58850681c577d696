"""On what structure without a name may depend in the table of a triad: channels, and variables for each.

Each output has an offset and a response to its own axis, each axis of the stand an error of its angle. A step at a
temperature is left out: in a run that warms up it is a step in time, which is commoner.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.observations import CHANNELS
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.tracing.common_coordinates import pose_of, temperature_of, time_of
from tumble.calibrations.tracing.components import Axis, Channel, axes
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.messages import Message


def unnamed(scene: TriadScene) -> tuple[Axis, ...]:
    """Everything along which a table could show structure without a name."""
    outputs = [pair for place in range(len(CHANNELS)) for pair in _of_an_output(scene, place)]
    return axes(*outputs, *_of_the_stand(scene), expected=(("offset", "time"), ("offset", "temperature")))


_Pair = tuple[Channel, tuple[Coordinate, ...]]


def _of_an_output(scene: TriadScene, place: int) -> Iterator[_Pair]:
    """Its offset and its response, each with what it may follow."""
    name, felt_g = CHANNELS[place], scene.felt_g[:, place]
    offset = Channel(
        word="offset",
        detail=name,
        gain=scene.in_channel(place, np.ones(scene.dwells)),
        phrase=Message("an offset of channel {channel}", channel=name),
        unit="V",
    )
    scale = Channel(
        word="scale",
        detail=name,
        gain=scene.in_channel(place, felt_g),
        phrase=Message("a change of the response of channel {channel}", channel=name),
        unit="V/g",
    )
    passing = tuple(_in_rows(each) for each in (*_of_the_time(scene), *_of_the_warmth(scene, place)))
    visits = tuple(_in_rows(each) for each in (*_of_the_moves(scene), *_of_the_realisation(scene)))
    inputs = tuple(_in_rows(each) for each in _of_the_input(scene, felt_g))
    yield offset, (*inputs, *passing, *visits)
    yield scale, (*passing, *visits)


def _of_the_stand(scene: TriadScene) -> Iterator[_Pair]:
    """Errors of the angle of each axis."""
    rows = scene.observations
    for phrase, gain, angle_deg, detail in (
        (Message("an error of the outer axis"), scene.outer_v, rows.outer_deg, "outer"),
        (Message("an error of the inner axis"), scene.inner_v, rows.inner_deg, "inner"),
    ):
        own = Coordinate(
            word="angle",
            depends_on="angle",
            values=angle_deg % 360.0,
            period=360.0,
            shown="{:.0f}°".format,
            bumps=True,
            steps=True,
            overtones=True,
            phrase=Message("that follows its angle"),
            unit="deg",
        )
        error = Channel(word="angle", detail=detail, gain=gain, phrase=phrase, unit="rad")
        yield error, tuple(_in_rows(each) for each in (own, *_of_the_time(scene)))


def _in_rows(coordinate: Coordinate) -> Coordinate:
    """A variable of the dwells as one of the rows, which are three for each of them."""
    return replace(coordinate, values=np.repeat(coordinate.values, 3, axis=0), outputs=3)


def _of_the_input(scene: TriadScene, felt_g: FloatArray) -> Iterator[Coordinate]:
    yield Coordinate(
        word="acceleration",
        depends_on="acceleration",
        values=felt_g,
        shown="{:.2f} g".format,
        kinks=True,
        bumps=True,
        phrase=Message("that follows the acceleration along its axis"),
        unit="g",
    )
    yield pose_of(scene.gravity_g)


def _of_the_time(scene: TriadScene) -> Iterator[Coordinate]:
    if scene.dwell_hours is not None:
        yield time_of(scene.dwell_hours)


def _of_the_warmth(scene: TriadScene, place: int) -> Iterator[Coordinate]:
    if scene.temperature_k is not None and np.ptp(scene.temperature_k[:, place]):
        yield temperature_of(scene.temperature_k[:, place] + scene.reference_temperature_degc)


def _of_the_moves(scene: TriadScene) -> Iterator[Coordinate]:
    for detail, direction, phrase in (
        ("outer", scene.outer_direction, Message("that follows the direction of the last move of the outer axis")),
        ("inner", scene.inner_direction, Message("that follows the direction of the last move of the inner axis")),
    ):
        yield Coordinate(
            word="direction",
            depends_on="direction",
            values=direction.astype(float),
            ordered=False,
            phrase=phrase,
            detail=detail,
        )


def _of_the_realisation(scene: TriadScene) -> Iterator[Coordinate]:
    yield Coordinate(
        word="realisation",
        depends_on="realisation",
        values=scene.realisation.astype(float),
        ordered=False,
        phrase=Message("that differs between realisations"),
        recurs=False,
    )
