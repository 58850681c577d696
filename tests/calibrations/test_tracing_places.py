"""On which variable structure without a name lives, and which experiment would tell."""

import numpy as np
import pytest
from tracing_runs import FLIPS, SWEEP, programme, runs

from tumble.calibrations.methods.dividing_head.effects.unnamed import unnamed
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop, explain
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.continued import continued
from tumble.calibrations.tracing.experiments import locating_experiments
from tumble.calibrations.tracing.places import PlaceQuestion, places
from tumble.calibrations.tracing.stage import stage_of
from tumble.messages import Message

OWN = programme(FLIPS, SWEEP.format("face-up", "up"), realisations=3)
BY_NAME = {probe.programme: probe for probe in PROBES}


def bell(columns):
    """500 µV near a head angle of 133°, some 14° wide."""
    return 5e-4 * np.exp(-0.5 * ((columns["angle_deg"] - 133.0) / 14.0) ** 2)


@pytest.fixture(scope="module")
def closed():
    """The loop closed on an offset or an error of the angle, which go together in one mount, and what it rests on."""
    return explain(runs(OWN, extra_v=bell))


@pytest.fixture(scope="module")
def ambiguous(closed):
    return closed[1]


@pytest.fixture(scope="module")
def question(ambiguous):
    return PlaceQuestion(ambiguous.table, ambiguous.trace, ambiguous.alike)


def test_the_places_are_channels_and_variables_the_found_one_first(ambiguous):
    assert places(ambiguous.trace, ambiguous.alike) == ("offset × angle", "offset × pose", "angle × angle")


def test_what_has_no_name_is_as_disputed_as_an_effect_with_rivals(closed):
    assert stage_of(*closed).disputed == (("offset × angle", "offset × pose", "angle × angle"),)


def test_a_mount_that_takes_ax_away_tells_an_offset_from_an_error_of_the_angle(ambiguous):
    (experiment,) = locating_experiments(ambiguous.table, ambiguous.trace, ambiguous.alike, PROBES)
    assert experiment.programme == "probe-end"
    assert experiment.separates == ("offset × angle", "offset × pose", "angle × angle")
    assert experiment.least > 9.0
    assert experiment.outlook is None


def test_once_it_was_run_only_the_true_place_is_left():
    unexplained = close_loop(runs(OWN, "probe-end", extra_v=bell)).unexplained
    assert (unexplained.channel, unexplained.variable, unexplained.also_possible) == ("offset", "angle", ())


def test_nothing_is_asked_where_one_place_is_left(ambiguous):
    assert locating_experiments(ambiguous.table, ambiguous.trace, [], PROBES) == ()


def test_the_same_poses_once_more_tell_no_place_and_nothing_is_promised(question):
    expected = question.expected(question.table.followed_by(BY_NAME["probe-repeat"]))
    assert np.abs(expected.separations[:, 1]).max() < 3.0  # a spot in space is not quite of the same shape
    assert expected.promises.max() < question.needed


def test_a_promise_is_less_than_the_expectation_by_the_noise_of_the_prediction(question):
    expected = question.expected(question.table.followed_by(BY_NAME["probe-end"]))
    assert (expected.promises < expected.separations).all()
    assert (expected.promises > 0.3 * expected.separations).all()


def test_without_further_rows_nothing_is_gained(question):
    expected = question.expected(question.table)
    assert expected.promises.tolist() == [question.behind.tolist(), (-question.behind).tolist()]


def component(scene, name, shape):
    axis = next(axis for axis in unnamed(scene) if axis.name == name)
    nothing = np.zeros((scene.rows, 1))
    return Component(axis=axis, shape=shape, columns=nothing, whole=nothing, penalty=0.0, described=Message("it"))


@pytest.mark.parametrize("shape", ["wave 7.5", "broken 3"])
def test_structure_in_time_goes_on_in_further_rows_as_in_the_table(ambiguous, shape):
    table, probe = ambiguous.table, BY_NAME["probe-repeat"]
    rows = probe.after(table.observations)
    theta = ambiguous.best.joint.fit.theta
    known, scene = table.view(table.observations, theta), table.view(rows, theta)
    (axis,) = (axis for axis in unnamed(scene) if axis.name == "offset that follows the time")
    own = component(known, axis.name, shape)
    columns, alone = continued(own, axis, scene.rows), continued(own, own.axis, known.rows)
    rows_alike = (columns @ columns.T)[: known.rows, : known.rows]
    assert np.abs(rows_alike - alone @ alone.T).max() < 0.1


def test_what_happened_once_may_happen_in_any_way_in_later_rows(ambiguous):
    table = ambiguous.table
    scene = table.view(BY_NAME["probe-end"].after(table.observations), ambiguous.best.joint.fit.theta)
    (axis,) = (axis for axis in unnamed(scene) if axis.name == "offset that follows the time")
    columns = continued(component(table.scene, axis.name, "step 0.4"), axis, scene.rows)
    assert columns.shape[1] > 10
    assert np.sum(columns**2, axis=1) == pytest.approx(1.0, abs=0.03)


def test_a_table_that_says_nothing_of_a_parameter_can_be_planned_for():
    """One mount in which Oz stays level: what az does would be anybody's guess, and is the same in every place."""
    _, explained = explain(runs(programme(SWEEP.format("face-up", "up"), realisations=2), extra_v=bell))
    question = PlaceQuestion(explained.table, explained.trace, explained.alike)
    for probe in (BY_NAME["probe-end"], BY_NAME["probe-edge"]):
        assert np.isfinite(question.expected(question.table.followed_by(probe)).promises).all()


def test_structure_along_what_further_rows_do_not_have_does_not_go_on(ambiguous):
    own = component(ambiguous.table.scene, "offset that follows the time", "wave 3")
    assert continued(own, None, 300)[ambiguous.table.rows :].tolist() == [[0.0]] * (300 - ambiguous.table.rows)
