"""Structure without a name as variance components: the likelihood, what it costs, and on what it is put."""

from dataclasses import dataclass

import numpy as np
import pytest

from tumble.calibrations.tracing.beyond import alike, traced
from tumble.calibrations.tracing.components import Channel, axes
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.gains import seen_beside
from tumble.calibrations.tracing.noise import WHITE, Memory, slow_modes
from tumble.calibrations.tracing.penalties import of_variance
from tumble.calibrations.tracing.scan import Scan
from tumble.calibrations.tracing.spectrum import wave_squares, wave_sums
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Tracer
from tumble.messages import Message

ROWS = 240
COUNT = np.arange(ROWS)
ANGLE_DEG = 5.0 * (COUNT % 72)
HOURS = COUNT / 360.0
PLACE = np.random.default_rng(3).permutation(ROWS) / ROWS
OFFSET = Channel(word="offset", gain=np.ones(ROWS), phrase=Message("an offset"))
SCALE = Channel(word="scale", gain=np.sin(np.deg2rad(ANGLE_DEG)), phrase=Message("a scale"))
TIME = Coordinate(word="time", depends_on="time", values=HOURS, waves=True, steps=True, phrase=Message("of time"))
ANGLE = Coordinate(
    word="angle", depends_on="angle", values=ANGLE_DEG, period=360.0, bumps=True, steps=True, phrase=Message("of it")
)
ORDER = Coordinate(word="order", depends_on="order", values=PLACE, bumps=True, phrase=Message("of order"))
AXES = axes((OFFSET, (TIME, ANGLE, ORDER)), (SCALE, (TIME, ORDER)))


@dataclass(frozen=True)
class Bare:
    rows: int = ROWS
    hours: None = None


def noise(seed=1):
    return np.random.default_rng(seed).normal(size=ROWS)


def table_of(output, wanders=False):
    weights = np.ones(ROWS)
    return Table(
        model=Linear(functions=np.column_stack([np.ones(ROWS), SCALE.gain])),
        output=output,
        unit="V",
        weights=weights,
        scene=Bare(),
        effects=(),
        structures=(),
        memory=Memory(modes=slow_modes(HOURS if wanders else None, weights)),
        axes=AXES,
    )


def traced_places(output, wanders=False):
    table = table_of(output, wanders)
    trace = traced(Tracer(table), Scan(table.axes)).trace
    return [component.place for component in trace.components]


def proposed(table, place, shape):
    proposals = Scan(table.axes, 0.001).proposals(seen_beside(table, [], WHITE))
    return next(each for each in proposals if each.axis.place == place and each.shape.startswith(shape))


def _whole_gain(table, best):
    beside = table.with_seen([best.component])
    return table.deviance((), WHITE) - beside.deviance((), WHITE.with_level(best.component.name, best.variance))


@pytest.mark.parametrize(
    ("place", "shape", "signal"),
    [
        (("offset", "angle"), "smooth", 2.0 * np.cos(np.deg2rad(3.0 * ANGLE_DEG))),
        (("offset", "time"), "wave", 1.5 * np.sin(2.0 * np.pi * 60.0 * HOURS / HOURS[-1])),
        (("offset", "time"), "pulse", 3.0 * ((COUNT > 100) & (COUNT < 150))),
        (("scale", "time"), "step", 3.0 * SCALE.gain * (COUNT > 130)),
        (("offset", "order"), "bump", 4.0 * np.exp(-0.5 * ((PLACE - 0.4) / 0.05) ** 2)),
    ],
)
def test_the_gain_of_the_scan_is_that_of_the_whole_likelihood(place, shape, signal):
    table = table_of(signal + noise())
    best = proposed(table, place, shape)

    assert best.gain == pytest.approx(_whole_gain(table, best), abs=1e-6)


@pytest.mark.parametrize(
    ("place", "signal"),
    [
        (("offset", "angle"), 2.0 * np.exp(-0.5 * ((ANGLE_DEG - 140.0) / 12.0) ** 2)),
        (("offset", "time"), 1.5 * (COUNT > 130)),
        (("offset", "order"), 3.0 * (2.0 * PLACE - 1.0) ** 2),
        (("scale", "time"), 2.0 * SCALE.gain * np.sin(14.0 * HOURS)),
        (("scale", "order"), 2.0 * SCALE.gain * (PLACE > 0.5) * PLACE),
    ],
)
def test_structure_is_put_on_its_channel_and_variable(place, signal):
    assert traced_places(signal + noise())[:1] == [place]


def test_two_at_once_are_both_found():
    signal = 2.0 * (COUNT > 130) + 3.0 * np.exp(-0.5 * ((ANGLE_DEG - 140.0) / 12.0) ** 2)

    assert set(traced_places(signal + noise())) == {("offset", "time"), ("offset", "angle")}


@pytest.mark.parametrize("seed", range(8))
def test_clean_rows_show_nothing(seed):
    assert traced_places(noise(seed)) == []


def test_a_wave_faster_than_forty_turns_is_found_up_to_the_nyquist_limit():
    assert traced_places(np.sin(2.0 * np.pi * 97.3 * HOURS / HOURS[-1]) + noise()) == [("offset", "time")]


def test_wandering_is_not_structure_in_time():
    wandering = np.cumsum(np.random.default_rng(5).normal(size=ROWS)) * 0.4

    assert traced_places(wandering + noise(), wanders=True) == []


def test_what_the_rows_do_not_part_is_said():
    """A wave once round the circle of a run of three turns is one of time too."""
    table = table_of(2.0 * np.sin(np.deg2rad(2.0 * ANGLE_DEG)) + noise())
    scan = Scan(table.axes)
    found = traced(Tracer(table), scan)
    places = {each.components[0].place for each in (found.trace, *alike(found.tracer, found.trace, scan))}

    assert places >= {("offset", "angle"), ("offset", "time")}


def test_with_few_rows_no_bin_is_a_row_of_its_own():
    few = Coordinate(word="time", depends_on="time", values=HOURS[:24], phrase=Message("of time"))

    assert int(few.bins.max()) + 1 == 8


def test_labels_are_never_put_into_bins_of_several():
    labels = Coordinate(word="realisation", depends_on="realisation", values=COUNT[:6] % 3, ordered=False,
                        phrase=Message("of runs"))  # fmt: skip

    assert int(labels.bins.max()) + 1 == 3


@pytest.mark.parametrize(("chance", "fall"), [(0.5, 0.0), (0.025, 3.841), (0.0005, 10.83)])
def test_the_penalty_is_the_fall_that_a_variance_without_meaning_reaches_by_chance(chance, fall):
    assert of_variance(chance) == pytest.approx(fall, abs=5e-3)


def test_the_scan_of_waves_shows_the_power_of_the_fastest_to_two_per_cent():
    phase = 2.0 * np.pi * 49.5 * HOURS / HOURS[-1]
    sines, cosines = wave_sums(HOURS / HOURS[-1], 100, np.sin(phase + 0.7)[:, None])
    power = np.hypot(sines[0], cosines[0])

    assert np.argmax(power) == 98
    assert power[98] == pytest.approx(
        np.hypot(*(np.sin(phase + 0.7) @ side(phase) for side in (np.sin, np.cos))), rel=0.02
    )


def test_squares_of_waves_are_their_sums():
    part, weights = HOURS / HOURS[-1], 1.0 + PLACE
    phase = np.pi * np.outer(part, np.arange(1, 101))
    squares = wave_squares(part, 100, weights)
    exact = weights @ np.sin(phase) ** 2, weights @ np.cos(phase) ** 2, weights @ (np.sin(phase) * np.cos(phase))

    assert np.array(squares) == pytest.approx(np.array(exact), abs=0.02 * weights.sum())


@pytest.mark.parametrize("off", [(ANGLE_DEG > 290.0) | (ANGLE_DEG < 40.0), (ANGLE_DEG > 130.0) & (ANGLE_DEG < 240.0)])
def test_of_a_circle_the_shorter_arc_is_off(off):
    best = proposed(table_of(4.0 * off + noise()), ("offset", "angle"), "pulse")

    assert np.array_equal(best.component.columns[:, 0] > 0.0, off)
    assert best.gain == pytest.approx(_whole_gain(table_of(4.0 * off + noise()), best), abs=1e-6)
