"""The course of an adopted effect: over knots, from several units, and what a run shows beside it."""

import numpy as np
import pytest
from adopted_examples import BUMP, KNOTS, PLACES, SAW, STEPS, run

from tumble.calibrations.adopted.curve import Curve
from tumble.calibrations.adopted.knots import Knots, knots_of
from tumble.calibrations.adopted.left import left
from tumble.calibrations.adopted.shared import expected, shared
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.messages import Message

FIVE = (1.3, 0.8, 1.0, 0.7, 1.2)


def coordinate(values, **more):
    return Coordinate(
        word="temperature", depends_on="temperature", values=np.array(values), phrase=Message("that"), **more
    )


def test_between_two_knots_a_course_is_a_straight_line():
    assert KNOTS.basis(np.array([0.05])) @ PLACES == pytest.approx([0.05])


def test_at_a_knot_it_is_what_is_known_there():
    assert KNOTS.basis(np.array([PLACES[7]]))[0].tolist() == pytest.approx(np.eye(21)[7].tolist())


def test_a_turn_comes_back_on_itself():
    turn = knots_of([coordinate([0.0, 200.0], period=360.0)])
    sine = np.sin(np.radians(turn.places[:, 0]))

    assert turn.basis(np.array([357.5, 717.5])) @ sine == pytest.approx(2 * [0.5 * np.sin(np.radians(355.0))])


def test_beyond_what_was_measured_nothing_is_known():
    assert KNOTS.beyond(np.array([-1.01, 0.0, 1.2])).tolist() == [False, False, True]


def test_of_a_turn_nothing_lies_beyond():
    assert not Knots(places=np.arange(4.0)[:, None] * 90.0, period=360.0).beyond(np.array([5000.0])).any()


def test_labels_have_no_neighbours():
    signs = knots_of([coordinate([-1.0, 1.0, 1.0], ordered=False)])

    assert signs.basis(np.array([1.0, -1.0])).tolist() == [[0.0, 1.0], [1.0, 0.0]]
    assert signs.beyond(np.array([0.0])).tolist() == [True]


def test_places_in_space_are_known_near_where_they_were_seen():
    poses = knots_of([coordinate([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])])

    assert poses.beyond(np.array([[0.99, 0.02, 0.0], [0.0, 1.0, 0.0]])).tolist() == [False, True]


def test_knots_span_all_tables():
    both = knots_of([coordinate([20.0, 25.0]), coordinate([22.0, 40.0])])

    assert (both.places[0, 0], both.places[-1, 0]) == (20.0, 40.0)


def test_sizes_come_back_in_those_of_their_mean():
    found = shared([run(size) for size in FIVE], KNOTS)

    assert [each.value for each in found.sizes] == pytest.approx(FIVE, abs=0.05)


def test_the_course_comes_back():
    found = shared([run(size) for size in FIVE], KNOTS)

    assert found.curve.values == pytest.approx(BUMP, abs=0.12)


def test_the_course_is_within_its_uncertainty():
    found = shared([run(size, scatter=0.0 * SAW) for size in FIVE], KNOTS)

    assert np.all(np.abs(found.curve.values - BUMP) < 2.0 * found.curve.standard_uncertainty)


def test_the_spread_is_that_beyond_what_measurements_scatter_by():
    assert shared([run(size) for size in FIVE], KNOTS).spread == pytest.approx(np.std(FIVE, ddof=1), rel=0.1)


def test_of_one_unit_no_spread_is_known():
    found = shared([run(0.8)], KNOTS)

    assert (found.spread, found.sizes[0].value, expected(found.spread, 1)) == (None, 1.0, None)


def test_units_with_opposite_signs_have_nothing_in_common():
    assert not shared([run(1.0), run(-1.0), run(0.9), run(-1.1)], KNOTS).in_common


def test_a_weak_unit_does_not_hide_what_the_others_share():
    assert shared([run(1.0), run(1.1), run(0.1)], KNOTS).in_common


def test_the_next_unit_is_known_less_well_from_few_units():
    many, few = expected(0.2, 1000), expected(0.2, 3)

    assert many is not None
    assert few is not None
    assert many.standard_deviation == pytest.approx(0.2, rel=0.01)
    assert few.standard_deviation == pytest.approx(0.2 * 4.303 / 1.96 * (4 / 3) ** 0.5, rel=0.001)


def known(uncertainty=0.01):
    return Curve(knots=KNOTS, values=BUMP, covariance=uncertainty**2 * np.eye(21))


@pytest.mark.parametrize("size", [0.5, 1.0, 1.6])
def test_a_run_of_another_size_has_no_other_course(size):
    assert not left(run(size), known(), size)


def test_a_step_beside_the_course_is_another_course():
    assert left(run(1.0, course=BUMP + STEPS), known(), 1.0)


def test_what_is_not_known_of_the_course_is_no_other_course():
    assert not left(run(1.0, course=BUMP + STEPS), known(uncertainty=1.0), 1.0)
