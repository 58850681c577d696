"""The last point of a run, taken again as the operator wishes."""

from collections import Counter
from dataclasses import replace

import pytest
from fake_runs import dwells, states, when
from fakes import QUICK, FakeHead, FakeStand
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.errors import LinkLostError
from tumble.drivers.protocols import Identity
from tumble.procedures.approach import Approach
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    FinishReason,
    PointCompleted,
    RetakeBegun,
    SamplesAcquired,
    State,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.steps import Dwell

SEEKING = programme_from_text(
    'name = "a"\nrealisations = 2\n[[procedure]]\nkind = "flip"\naxes = ["x", "z"]\npole = "extremum"\n', "a.toml"
)
"""Goes where the points before have shown the extremum, and through two mounts."""

TWO_MOUNTS = programme_from_text(
    'name = "a"\n'
    + "".join(
        f'[[procedure]]\nkind = "sweep"\nmount = "{mount}"\nstep_deg = 5\npoints = 2\n' for mount in ("face-up", "end")
    ),
    "a.toml",
)


def fast_stand():
    stand = FakeStand()
    stand.head.speed_deg_s = 1e4
    return stand


def completed(stand):
    return [(event.point.index, event.point.take) for event in stand.sink.of(PointCompleted)]


def settings(points):
    """Where points were taken, and what they gave."""
    return [(point.index, point.conditions, point.positions_deg, point.readings) for point in points]


def warnings(stand):
    return [event.message for event in stand.sink.of(WarningRaised)]


def at_angle(stand, angle_deg, do):
    """Have something done once, when the moving head has come as far as an angle."""
    done = []

    def look():
        if not done and stand.head._angle_deg() > angle_deg:
            done.append(True)
            do()

    stand.head.on_status = look


def test_the_later_reading_takes_the_place_of_the_one_before(stand: FakeStand):
    engine = stand.engine()
    at_angle(stand, 25.0, lambda: engine.control.take_again(1))
    stand.daq.creep_v = 0.001
    outcome = engine.run(dwells(10.0, 20.0, 30.0))
    assert completed(stand) == [(0, 1), (1, 1), (1, 2), (2, 1)]
    assert [(point.index, point.take) for point in outcome.points] == [(0, 1), (1, 2), (2, 1)]
    first, second = (event.point for event in stand.sink.of(PointCompleted) if event.point.index == 1)
    assert outcome.points[1] == second
    assert second.readings["voltage_v"].mean > first.readings["voltage_v"].mean
    assert outcome.reason is FinishReason.COMPLETED


def test_the_head_turns_back_at_once_and_comes_from_the_same_side(stand: FakeStand):
    engine = stand.engine()
    at_angle(stand, 25.0, lambda: engine.control.take_again(1))
    outcome = engine.run(dwells(10.0, 20.0, 90.0))
    assert stand.head.targets_deg == [10.0, 20.0, 90.0, 18.0, 20.0, 90.0]
    assert [point.directions["head"] for point in outcome.points] == [1, 1, 1]
    assert states(stand).count(State.PAUSED) == 0


def test_a_point_that_was_come_to_from_the_reference_is_come_to_from_there_again(stand: FakeStand):
    """A head with backlash would read otherwise, were it come to from the other side."""
    engine = stand.engine()
    at_angle(stand, 5.0, lambda: engine.control.take_again(0))
    homed = []
    stand.head.home = lambda: (homed.append(stand.head._angle_deg()), FakeHead.home(stand.head))
    outcome = engine.run(dwells(0.0, 20.0))
    assert [round(angle_deg) for angle_deg in homed] == [7]
    assert [(point.take, point.directions["head"]) for point in outcome.points] == [(2, 0), (1, 1)]


def test_one_that_has_not_moved_since_is_not_sent_to_its_reference(stand: FakeStand):
    engine = stand.engine(listeners=[when(PointCompleted, lambda: engine.control.take_again(0))])
    stand.head.home = lambda: pytest.fail("it was homed")
    outcome = engine.run(dwells(0.0))
    assert [(point.take, point.directions["head"]) for point in outcome.points] == [(2, 0)]


def test_where_the_programme_says_from_which_side_that_holds_for_a_point_without_one(stand: FakeStand):
    engine = stand.engine(replace(QUICK, approach=Approach(direction=1)))
    journal = [replace(point, directions={"head": 0}) for point in fast_stand().engine().run(dwells(10.0)).points]
    at_angle(stand, 15.0, lambda: engine.control.take_again(0))
    engine.resume(dwells(10.0, 20.0), journal)
    retaken = next(event.point for event in stand.sink.of(PointCompleted))
    assert (retaken.take, retaken.directions["head"]) == (2, 1)


def test_it_is_said_before_the_point_and_after_it(stand: FakeStand):
    engine = stand.engine()
    at_angle(stand, 25.0, lambda: engine.control.take_again(1))
    engine.run(dwells(10.0, 20.0, 30.0))
    kinds = (RetakeBegun, SamplesAcquired, PointCompleted, WarningRaised)
    begun = stand.sink.events.index(RetakeBegun(point=1))
    heard = [type(event) for event in stand.sink.events[begun:] if isinstance(event, kinds)]
    assert heard == [RetakeBegun, SamplesAcquired, PointCompleted, WarningRaised, SamplesAcquired, PointCompleted]
    assert warnings(stand) == [
        "point 1 (face-up at 20 deg) was taken again as the operator wished; the later reading is used "
        "(voltage_v: 2.15798 V now, 2.15798 V before)"
    ]
    assert [(event.point, event.take) for event in stand.sink.of(SamplesAcquired)] == [(0, 1), (1, 1), (1, 2), (2, 1)]


def test_the_last_point_of_all_can_be_taken_again_while_the_cable_is_unwound(stand: FakeStand):
    engine = stand.engine()
    unwinding = []

    def look():
        if len(stand.sink.of(PointCompleted)) == 1 and stand.head._angle_deg() < 300.0 and not unwinding:
            unwinding.append(True)
            engine.control.take_again(0)

    stand.head.on_status = look
    assert engine.run(dwells(360.0)).points[0].take == 2


def test_a_wish_while_samples_are_taken_means_the_point_before(stand: FakeStand):
    engine = stand.engine()
    blocks = []

    def acquire():
        blocks.append(stand.daq.blocks)
        if len(blocks) == 6:  # two to settle and one that counts, of each point
            engine.control.take_again(0)

    stand.daq.on_acquire = acquire
    engine.run(dwells(10.0, 20.0))
    assert completed(stand) == [(0, 1), (0, 2), (1, 1)]


def test_a_point_that_another_has_followed_is_left_as_it_is(stand: FakeStand):
    engine = stand.engine()
    at_angle(stand, 25.0, lambda: engine.control.take_again(0))
    outcome = engine.run(dwells(10.0, 20.0, 30.0))
    assert completed(stand) == [(0, 1), (1, 1), (2, 1)]
    assert warnings(stand) == ["point 0 is not taken again: it is not the last one any more"]
    assert outcome.reason is FinishReason.COMPLETED


def test_during_a_pause_nothing_moves_before_the_run_goes_on(stand: FakeStand):
    def pause():
        engine.control.pause()

    engine = stand.engine(listeners=[when(PointCompleted, pause)])
    sleep, paused_s = stand.clock.sleep, []

    def wait(duration_s):
        sleep(duration_s)
        if engine.state is State.PAUSED:
            paused_s.append(stand.clock.monotonic_s())
            engine.control.take_again(0)
            if stand.clock.monotonic_s() > 60.0:
                engine.control.resume()

    stand.clock.sleep = wait
    first, _ = engine.run(dwells(10.0, 20.0)).points
    assert first.take == 2
    assert first.time_s > paused_s[-1]
    assert stand.head.targets_deg == [10.0, 10.0, 20.0]


def test_a_mount_that_is_asked_for_is_asked_for_as_it_was(stand: FakeStand):
    """Nobody knows what the operator has done to the unit since he was asked for the next one."""
    engine = stand.engine()
    stand.operator.looks = 5

    def poll():
        if stand.operator.asked[-1] == "end" and len(stand.operator.asked) == 2:
            engine.control.take_again(1)

    stand.operator.on_poll = poll
    outcome = engine.run(TWO_MOUNTS.procedure)
    assert stand.operator.asked == ["face-up", "end", "face-up", "end"]
    assert completed(stand) == [(0, 1), (1, 1), (1, 2), (2, 1), (3, 1)]
    assert [event.value for event in stand.sink.of(ConditionAnswered)] == ["face-up", "face-up", "end"]
    assert [point.conditions["mount"] for point in outcome.points] == ["face-up", "face-up", "end", "end"]


def test_a_mount_that_was_not_changed_is_not_asked_for(stand: FakeStand):
    engine = stand.engine()
    at_angle(stand, 15.0, lambda: engine.control.take_again(0))
    engine.run(dwells(10.0, 20.0))
    assert [event.value for event in stand.sink.of(ConditionRequested)] == ["face-up"]


def test_a_procedure_goes_on_from_what_the_later_reading_shows(stand: FakeStand):
    """The second round of seeking an extremum goes by the points of the first: a bad one is taken again."""
    good = fast_stand().engine().run(SEEKING.procedure).points

    def disturb():
        stand.daq.creep_v = 0.05 if len(stand.sink.of(PointCompleted)) == 2 and not stand.sink.of(RetakeBegun) else 0.0

    def hear(event):
        if isinstance(event, PointCompleted) and event.point.index == 2 and event.point.take == 1:
            engine.control.take_again(2)

    stand.daq.on_acquire = disturb
    engine = stand.engine(listeners=[hear])
    points = engine.run(SEEKING.procedure).points
    bad = next(event.point for event in stand.sink.of(PointCompleted) if event.point.index == 2)
    assert bad.readings["voltage_v"].mean > good[2].readings["voltage_v"].mean + 0.05
    assert settings(points) == settings(good)


def test_a_stop_while_it_is_taken_again_keeps_the_point_that_was_there(stand: FakeStand):
    engine = stand.engine(listeners=[when(PointCompleted, lambda: engine.control.take_again(0))])
    stand.daq.on_acquire = lambda: engine.control.stop() if stand.sink.of(RetakeBegun) else None
    outcome = engine.run(dwells(10.0, 20.0))
    assert outcome.reason is FinishReason.STOPPED
    assert [(point.index, point.take) for point in outcome.points] == [(0, 1)]


@pytest.fixture
def cut_off(stand: FakeStand):
    """A stand whose head does not hear a command to stop, nor anything after it, until it is reconnected."""
    stop, lost = stand.head.stop, []

    def check():
        if lost:
            raise LinkLostError("fake head", "the port is gone", "check the cable")

    def cut(do):
        lost.append(True)
        do()

    stand.head.stop = lambda: (check(), stop())
    stand.head.identify = lambda: (check(), Identity(model="fake head", serial="1"))[1]
    stand.head.reconnect = lost.clear
    stand.cut = cut
    return stand


def test_a_wish_while_a_link_is_lost_on_the_way_is_kept(cut_off):
    engine = cut_off.engine()
    at_angle(cut_off, 25.0, lambda: cut_off.cut(lambda: engine.control.take_again(1)))
    outcome = engine.run(dwells(10.0, 20.0, 30.0))
    assert outcome.reason is FinishReason.COMPLETED
    assert completed(cut_off) == [(0, 1), (1, 1), (1, 2), (2, 1)]


def test_a_wish_while_a_link_is_lost_at_a_question_ends_no_run(cut_off):
    engine = cut_off.engine()
    cut_off.operator.looks = 5

    def poll():
        if cut_off.operator.asked == ["face-up", "end"]:
            cut_off.cut(lambda: engine.control.take_again(1))

    cut_off.operator.on_poll = poll
    outcome = engine.run(TWO_MOUNTS.procedure)
    assert outcome.reason is FinishReason.COMPLETED
    assert completed(cut_off) == [(0, 1), (1, 1), (1, 2), (2, 1), (3, 1)]


def test_a_wish_that_came_too_late_is_none_of_the_next_run(stand: FakeStand):
    control = fast_stand().engine().control
    control.take_again(0)
    engine = stand.engine()
    engine.control = control
    engine.run(dwells(10.0))
    assert warnings(stand) == []


WISHES = st.lists(st.tuples(st.sampled_from(["status", "acquire", "poll", "point"]), st.integers(0, 40)), max_size=6)


class Impatient:
    """Wishes the last point to be taken again at any moments: at looks, blocks, questions and points, by number."""

    def __init__(self, stand, wishes):
        self.stand, self.wishes, self.counts = stand, set(wishes), Counter()
        stand.head.on_status = lambda: self.come_to("status")
        stand.daq.on_acquire = lambda: self.come_to("acquire")
        stand.operator.on_poll = lambda: self.come_to("poll")
        self.engine = stand.engine(listeners=[self.hear])

    def hear(self, event):
        if isinstance(event, PointCompleted):
            self.come_to("point")

    def come_to(self, moment):
        self.counts[moment] += 1
        done = self.stand.sink.of(PointCompleted)
        if (moment, self.counts[moment]) in self.wishes and done:
            self.engine.control.take_again(done[-1].point.index)


@given(wishes=WISHES)
def test_whenever_it_is_wished_the_points_are_those_of_a_run_without(wishes):
    quiet, stand = fast_stand().engine().run(SEEKING.procedure), fast_stand()
    outcome = Impatient(stand, wishes).engine.run(SEEKING.procedure)
    assert outcome.reason is FinishReason.COMPLETED
    assert settings(outcome.points) == settings(quiet.points)
    taken = Counter(index for index, _ in completed(stand))
    assert [point.take for point in outcome.points] == [taken[point.index] for point in outcome.points]
    assert len(stand.sink.of(RetakeBegun)) >= sum(taken.values()) - len(outcome.points)
    assert [index for index, _ in completed(stand)] == sorted(index for index, _ in completed(stand))


@given(wishes=WISHES, data=st.data())
def test_a_run_with_points_taken_again_that_is_cut_anywhere_goes_on(wishes, data):
    quiet, first, second = fast_stand().engine().run(SEEKING.procedure), fast_stand(), fast_stand()
    cut = data.draw(st.integers(1, len(quiet.points) * 2), label="takes before the cut")
    first.sink.fails_at = lambda event: isinstance(event, PointCompleted) and len(first.sink.of(PointCompleted)) == cut
    journal = Impatient(first, wishes).engine.run(SEEKING.procedure).points
    outcome = second.engine().resume(SEEKING.procedure, journal)
    assert outcome.reason is FinishReason.COMPLETED
    assert settings(outcome.points) == settings(quiet.points)
    assert outcome.points[: len(journal)] == journal


def test_the_last_point_before_a_cut_can_be_taken_again_after_it(stand: FakeStand):
    journal = fast_stand().engine().run(dwells(10.0, 20.0, 30.0)).points[:2]
    engine = stand.engine()
    engine.control.take_again(1)
    outcome = engine.resume(dwells(10.0, 20.0, 30.0), journal)
    assert [(point.index, point.take) for point in outcome.points] == [(0, 1), (1, 2), (2, 1)]
    assert [replace(point, time_s=0.0) for point in outcome.points[:1]] == [replace(journal[0], time_s=0.0)]


@pytest.mark.parametrize("wished", [0, 3])
def test_a_point_that_is_not_there_is_not_taken(stand: FakeStand, wished):
    engine = stand.engine()
    at_angle(stand, 5.0, lambda: engine.control.take_again(wished))
    assert len(engine.run(dwells(10.0)).points) == 1
    assert warnings(stand) == [f"point {wished} is not taken again: it is not the last one any more"]
    assert [type(event.step) for event in stand.sink.of(StepStarted)].count(Dwell) == 1
