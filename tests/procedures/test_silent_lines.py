"""What a run does while an instrument is silent, or its link is lost, in the very moment of a pause or a stop."""

from dataclasses import replace
from functools import partial

import pytest
from fake_runs import dwells, states, when
from fakes import FakeStand
from linked_stand import LinkedDaq, LinkedHead
from two_axes import TwoAxesStand
from two_axes import dwell_at as dwell_on_two_axes

from tumble.drivers.errors import LinkLostError, NoReplyError
from tumble.procedures.events import FinishReason, PointCompleted, RunResumed, State, WarningRaised
from tumble.procedures.steps import Point


@pytest.fixture
def linked() -> FakeStand:
    stand = FakeStand()
    stand.head, stand.daq = (head := LinkedHead(stand.clock)), LinkedDaq(stand.clock, head)
    stand.operator.daq = stand.daq
    return stand


def taken(outcome) -> list[tuple[float, int]]:
    return [(point.positions_deg["head"], point.directions["head"]) for point in outcome.points]


def resuming(engine, clock, after_s):
    """Take a pause back after some time of a clock."""
    sleep = clock.sleep

    def wait(duration_s):
        sleep(duration_s)
        if engine.state is State.PAUSED and clock.monotonic_s() > after_s:
            engine.control.resume()

    clock.sleep = wait


def test_a_link_that_is_lost_as_the_run_halts_for_a_pause_is_awaited(linked):
    def pause():
        engine.control.pause()
        linked.head.link.pull(5.0)

    engine = linked.engine(listeners=[when(PointCompleted, pause)])
    resuming(engine, linked.clock, 60.0)
    outcome = engine.run(dwells(10.0, 20.0))
    assert outcome.reason is FinishReason.COMPLETED
    assert taken(outcome) == [(10.0, 1), (20.0, 1)]
    assert linked.head.homings == 1
    assert states(linked).count(State.PAUSED) == 1


def test_one_that_is_lost_before_the_first_step_is_awaited(linked):
    engine = linked.engine()
    engine.control.pause()
    linked.head.link.pull(5.0)
    resuming(engine, linked.clock, 60.0)
    assert engine.run(dwells(10.0)).reason is FinishReason.COMPLETED


def test_one_that_is_lost_as_a_wound_cable_is_looked_for_is_awaited(linked):
    journal: list[Point] = list(FakeStand().engine().run(dwells(400.0)).points)
    identify, status, asked = linked.head.identify, linked.head.status, []

    def lost_once_it_is_known():
        if asked and not linked.head.link.reopened:
            linked.head.link.open = False
        return status()

    linked.head.identify = lambda: (asked.append(True), identify())[1]
    linked.head.status = lost_once_it_is_known
    outcome = linked.engine().resume(dwells(400.0, 410.0), journal)
    assert outcome.reason is FinishReason.COMPLETED
    assert linked.sink.of(RunResumed)


def test_a_stop_does_not_wait_for_a_head_that_is_silent_as_it_halts_for_a_pause(stand):
    engine = stand.engine()
    engine.control.pause()

    def keep_silent():
        engine.control.stop()
        for _ in range(10):
            stand.clock.sleep(0.05)
            stand.attention.check()
        raise NoReplyError("fake head", "gave no answer", "check it")

    stand.head.on_status = keep_silent
    outcome = engine.run(dwells(10.0))
    assert outcome.message.startswith("the operator stopped the run")
    assert stand.head.stops > 1


def test_a_stop_does_not_wait_for_a_head_that_is_lost_as_it_halts_for_a_pause(linked):
    engine = linked.engine()
    engine.control.pause()
    stop, stopped_s = linked.head.stop, []

    def lose_it_then():
        stop()
        if not stopped_s:
            linked.head.link.pull(1e9)
            engine.control.stop()
            stopped_s.append(linked.clock.monotonic_s())

    linked.head.stop = lose_it_then
    outcome = engine.run(dwells(10.0))
    assert outcome.message.startswith("the operator stopped the run")
    assert linked.clock.monotonic_s() - stopped_s[0] < 11.0  # at the end its standstill is awaited for ten seconds


def both():
    yield replace(dwell_on_two_axes(90.0, 60.0), conditions={})


@pytest.fixture
def two_axes():
    stand = TwoAxesStand()
    stand.titles = {}
    return stand


def braked(stand):
    """Names of the axes in the order in which they are told to stop."""
    order = []
    for name in ("outer", "inner"):
        axis = getattr(stand, name)
        axis.stop = partial(lambda name, stop: (order.append(name), stop()), name, axis.stop)
    return order


def test_an_axis_that_turns_is_braked_before_one_that_is_silent(two_axes):
    engine, order = two_axes.engine(), braked(two_axes)

    def keep_silent():
        if two_axes.clock.monotonic_s() > 1.0 and not order:
            engine.control.stop()
            two_axes.attention.check()

    two_axes.outer.on_status = keep_silent
    assert engine.run(both).reason is FinishReason.STOPPED
    assert order[:2] == ["inner", "outer"]


def test_an_axis_that_turns_is_braked_before_one_that_rests(two_axes):
    engine, order = two_axes.engine(), braked(two_axes)

    def stop():
        if two_axes.outer.status().moving is False and two_axes.clock.monotonic_s() > 1.0:
            engine.control.stop()

    two_axes.inner.on_status = stop
    two_axes.outer.speed_deg_s = 90.0
    engine.run(both)
    assert order[:2] == ["inner", "outer"]


class TestTheInstrumentIsNamed:
    """Whatever the driver calls itself."""

    def test_in_the_error_of_a_run(self, linked):
        linked.daq.on_acquire = partial(linked.daq.link.pull, 1e9)
        error = linked.engine().run(dwells(10.0)).error
        assert (error.instrument, error.device) == ("daq", "fake DAQ")

    def test_where_links_are_lost_over_and_over(self, linked):
        linked.daq.on_acquire = partial(linked.daq.link.pull, 0.1)
        outcome = linked.engine().run(dwells(10.0))
        assert outcome.message.startswith("fake DAQ: was lost 10 times in one step")
        assert outcome.error.instrument == "daq"

    def test_in_the_sentence_where_there_are_several_of_its_kind(self, two_axes):

        def fail():
            raise NoReplyError("Zaber head (device 1, axis 1)", "gave no answer", "check it")

        two_axes.inner.stop = two_axes.inner.start_move = lambda *_: fail()
        outcome = two_axes.engine().run(both)
        assert outcome.error.instrument == "inner"
        assert outcome.message.startswith("inner (Zaber head (device 1, axis 1)): gave no answer; check it")

    def test_once(self, two_axes):

        def fail():
            raise LinkLostError("inner", "was lost", "plug it in")

        two_axes.inner.identify = fail
        outcome = two_axes.engine().run(both)
        assert outcome.message.startswith("inner: was lost, and did not come back")
        assert next(event.message for event in two_axes.sink.of(WarningRaised)) == "inner: was lost; trying to go on"
