"""Structure that changes at places of a variable, comes again, or wanders and is pulled back to its mean."""

from dataclasses import replace

import numpy as np
import pytest
from test_components import ANGLE, COUNT, HOURS, OFFSET, ORDER, PLACE, ROWS, SCALE, noise, proposed, table_of

from tumble.calibrations.tracing.beyond import traced
from tumble.calibrations.tracing.components import axes
from tumble.calibrations.tracing.continued import continued
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.calibrations.tracing.family import Family
from tumble.calibrations.tracing.gains import seen_beside
from tumble.calibrations.tracing.noise import WHITE
from tumble.calibrations.tracing.scan import Scan
from tumble.calibrations.tracing.shapes.onsets import transient
from tumble.calibrations.tracing.trace import Tracer
from tumble.messages import Message

TIME = Coordinate(
    word="time", depends_on="time", values=HOURS, waves=True, overtones=True, steps=True, kinks=True, onsets=True,
    phrase=Message("of time"),
)  # fmt: skip
CIRCLE = replace(ANGLE, overtones=True)
POSES_G = np.random.default_rng(11).normal(size=(60, 3))
POSES_G = (POSES_G / np.linalg.norm(POSES_G, axis=1)[:, None])[COUNT % 60]
POSE = Coordinate(word="pose", depends_on="acceleration", values=POSES_G, phrase=Message("of pose"))
SHUFFLED = replace(ORDER, kinks=True, steps=True)
AXES = axes((OFFSET, (TIME, CIRCLE, SHUFFLED, POSE)), (SCALE, (TIME,)), expected=(("offset", "time"),))
ALONG = {"ramp": "order", "spot": "pose"}
PART = COUNT / (ROWS - 1)
SINCE = np.maximum(PART - 0.4, 0.0)
REVERTING = np.random.default_rng(7).normal(size=ROWS)
for row in range(1, ROWS):
    REVERTING[row] += 0.85 * REVERTING[row - 1]
SIGNALS = {
    "ramp": 12.0 * np.clip(PLACE - 0.45, 0.0, 0.25),
    "onset": (PART > 0.4) * (2.0 + 5.0 * np.exp(-SINCE / 0.08)),
    "transient": 9.0 * (PART > 0.4) * (np.exp(-SINCE / 0.2) - np.exp(-SINCE / 0.03)),
    "changes": 2.0 * (np.searchsorted([0.15, 0.4, 0.55, 0.8], PART) % 2),
    "period": 4.0 * np.maximum(np.sin(2.0 * np.pi * 6.3 * PART), 0.0),
    "sawtooth": 3.0 * np.mod(6.3 * PART, 1.0),
    "square": 1.5 * np.sign(np.sin(2.0 * np.pi * 6.3 * PART)),
    "spot": 4.0 * np.exp(-8.0 * np.sum((POSES_G - POSES_G[7]) ** 2, axis=1)),
    "wandering": 2.0 * REVERTING,
}


def table(shape):
    return replace(table_of(SIGNALS[shape] + noise(), wanders=True), axes=AXES)


def shapes_of(rows, word):
    """The best of a kind along the first axis."""
    every = Family(rows.axes[0], 0.001).every(seen_beside(rows, [], WHITE))
    return [each for each in every if each.shape.split()[0] == word]


def component_of(shape):
    rows = table(shape)
    trace = traced(Tracer(rows), Scan(rows.axes)).trace
    (found,) = trace.components
    return found


@pytest.mark.parametrize("shape", SIGNALS)
def test_each_is_found_as_what_it_is_and_not_as_a_random_walk(shape):
    found = component_of(shape)

    assert (found.place, found.shape.split()[0]) == (("offset", ALONG.get(shape, "time")), shape)


@pytest.mark.parametrize("shape", SIGNALS)
def test_its_gain_in_the_scan_is_that_of_the_whole_likelihood(shape):
    rows = table(shape)
    best = proposed(rows, ("offset", ALONG.get(shape, "time")), shape)
    beside = rows.with_seen([best.component])
    whole = rows.deviance((), WHITE) - beside.deviance((), WHITE.with_level(best.component.name, best.variance))

    assert best.gain == pytest.approx(whole, abs=1e-6)


def test_a_knock_that_heals_is_a_transient_that_rises_at_once():
    column = transient(PART, np.array([[0.4, 0.0, 0.08]]))[:, 0]

    assert np.allclose(column, (PART > 0.4) * np.exp(-SINCE / 0.08))


def test_a_spot_between_poses_stands_on_several_rows():
    near = np.exp(-0.5 * np.sum((POSES_G - POSES_G[7]) ** 2, axis=1) / 0.15**2)
    rows = replace(table_of(6.0 * near + noise()), axes=axes((OFFSET, (POSE,))))
    (spot,) = shapes_of(rows, "spot")

    assert np.count_nonzero(spot.columns() > 0.6) >= POSE.fewest_rows


def test_a_slope_begins_and_ends_between_rows():
    """A dead band of few angles: no row is where it ends."""
    few = replace(SHUFFLED, values=np.round(12.0 * PLACE) / 12.0)
    band = 40.0 * np.clip(few.values, 0.27, 0.65)
    rows = replace(table_of(band + noise()), axes=axes((OFFSET, (few,))))
    *_, slope = shapes_of(rows, "ramp")

    assert [float(end) for end in slope.shape.split()[1:]] == pytest.approx([0.27, 0.65], abs=0.01)


def test_a_wave_that_jumps_is_found_beside_a_drift():
    drift = replace(table_of(6.0 * PART + SIGNALS["square"] + noise()), axes=AXES)
    (wave,) = shapes_of(drift, "square")

    assert float(wave.shape.split()[1]) == pytest.approx(6.3, abs=0.3)


ROUND = np.deg2rad(4.0 * CIRCLE.values + 10.0)


@pytest.mark.parametrize(
    ("wave", "shape"),
    [
        (2.0 * np.sign(np.sin(ROUND)), "square"),
        (np.mod(ROUND / (2.0 * np.pi), 1.0) * 4.0, "sawtooth"),
        (np.maximum(np.sin(ROUND), 0.0) * 4.0, "period"),
    ],
    ids=["square", "sawtooth", "half a sine"],
)
def test_a_wave_of_a_circle_has_its_shape_and_its_number(wave, shape):
    rows = replace(table_of(wave + noise()), axes=AXES)
    (found,) = traced(Tracer(rows), Scan(rows.axes)).trace.components

    assert (found.place, found.shape.split()[:2]) == (("offset", "angle"), [shape, "4"])


@pytest.mark.parametrize("shape", ["ramp", "onset", "transient", "changes", "period", "sawtooth", "square", "spot"])
def test_in_rows_of_the_same_run_it_is_the_same(shape):
    found = component_of(shape)

    assert np.allclose(continued(found, found.axis, ROWS), found.columns, atol=2e-3 * np.ptp(found.columns))


def test_a_place_of_no_row_costs_no_warning():
    """Of a scale that is zero after the last place, nothing is seen there."""
    gain = SCALE.gain * (COUNT < ROWS // 2)
    rows = replace(table_of(noise()), axes=axes((replace(SCALE, gain=gain), (TIME,))))

    assert traced(Tracer(rows), Scan(rows.axes)).trace.components == ()
