import pytest
from fake_runs import dwells, states, when
from fakes import FakeStand

from tumble.procedures.events import (
    ConditionAnswered,
    FinishReason,
    PointCompleted,
    RunFinished,
    State,
    StateChanged,
)


def test_a_stop_before_the_run_keeps_everything_still(stand: FakeStand):
    engine = stand.engine()
    engine.control.stop()
    assert engine.run(dwells(10.0)).reason is FinishReason.STOPPED
    assert stand.head.targets_deg == []


def test_a_stop_while_the_operator_is_awaited_ends_the_run(stand: FakeStand):
    stand.operator.looks = 10**9
    engine = stand.engine()
    stand.operator.on_poll = lambda: engine.control.stop() if stand.clock.monotonic_s() > 60.0 else None
    assert engine.run(dwells(10.0)).reason is FinishReason.STOPPED
    assert stand.sink.of(ConditionAnswered) == []


def test_a_stop_between_points_keeps_those_that_are_there(stand: FakeStand):
    def stop():
        engine.control.stop()

    engine = stand.engine(listeners=[when(PointCompleted, stop)])
    outcome = engine.run(dwells(10.0, 20.0))
    assert (outcome.reason, len(outcome.points)) == (FinishReason.STOPPED, 1)
    assert outcome.message == "the operator stopped the run"
    assert engine.state is State.STANDSTILL


def test_a_stop_while_the_output_settles_takes_no_point(stand: FakeStand):
    engine = stand.engine()
    stand.daq.on_acquire = engine.control.stop
    assert engine.run(dwells(10.0)).points == ()
    assert stand.daq.blocks == 1


def test_a_stop_does_not_wait_for_a_meter_that_is_silent(stand: FakeStand):
    engine = stand.engine()

    def keep_silent():
        engine.control.stop()
        stand.attention.check()
        raise AssertionError("the wait went on")

    stand.daq.on_acquire = keep_silent
    outcome = engine.run(dwells(10.0))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STOPPED, True)
    assert stand.head.stops > 0


def test_at_the_end_of_a_run_that_was_stopped_an_answer_is_awaited(stand: FakeStand):
    waited = []

    def await_an_answer():
        stand.attention.check()
        waited.append(True)

    engine = stand.engine()
    engine.control.stop()
    stand.head.on_status = await_an_answer
    assert engine.run(dwells(10.0)).at_standstill
    assert waited


def test_a_pause_lasts_until_it_is_taken_back(stand: FakeStand):
    def pause():
        engine.control.pause()

    engine = stand.engine(listeners=[when(PointCompleted, pause)])
    sleep = stand.clock.sleep

    def resume_after_a_minute(duration_s):
        sleep(duration_s)
        if stand.clock.monotonic_s() > 60.0:
            engine.control.resume()

    stand.clock.sleep = resume_after_a_minute
    first, second = engine.run(dwells(10.0, 20.0)).points
    assert first.time_s < 10.0
    assert second.time_s > 60.0
    assert states(stand)[3:5] == [State.PAUSED, State.RUNNING]


def test_a_pause_brakes_a_moving_head_and_the_move_goes_on_after_it(stand: FakeStand):
    engine = stand.engine()
    rested_deg = []

    def pause_for_a_while():
        now_s = stand.clock.monotonic_s()
        if 1.0 < now_s < 2.0:
            engine.control.pause()

    sleep = stand.clock.sleep

    def watch(duration_s):
        sleep(duration_s)
        if engine.state is State.PAUSED:
            rested_deg.append(stand.head.status().angle_deg)
            if stand.clock.monotonic_s() > 30.0:
                engine.control.resume()

    stand.head.on_status = pause_for_a_while
    stand.clock.sleep = watch
    (point,) = engine.run(dwells(90.0)).points
    assert len(set(rested_deg)) == 1
    assert stand.head.targets_deg == [90.0, 90.0]
    assert (point.positions_deg["head"], point.directions["head"]) == (90.0, 1)


def test_a_head_that_cannot_be_paused_ends_the_run(stand: FakeStand):
    engine = stand.engine()
    engine.control.pause()
    stand.head.coasting = True
    outcome = engine.run(dwells(10.0))
    assert outcome.message.startswith("dividing head: cannot be brought to rest; switch it off and look at it")
    assert State.PAUSED not in states(stand)
    assert not outcome.at_standstill


def test_a_stop_ends_a_pause(stand: FakeStand):
    engine = stand.engine()
    engine.control.pause()
    stand.clock.sleep = lambda duration_s: engine.control.stop()
    outcome = engine.run(dwells(10.0))
    assert outcome.reason is FinishReason.STOPPED


def test_an_interrupt_from_the_keyboard_is_a_stop(stand: FakeStand):
    def interrupt():
        stand.daq.on_acquire = lambda: None
        raise KeyboardInterrupt

    stand.daq.on_acquire = interrupt
    outcome = stand.engine().run(dwells(10.0))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STOPPED, True)
    assert outcome.message == "the operator interrupted the program"


def test_an_interrupt_while_the_head_comes_to_rest_leaves_the_standstill_open(stand: FakeStand):
    def interrupt():
        raise KeyboardInterrupt

    def arm(event):
        if event == StateChanged(state=State.STOPPING, reason="the programme was carried out"):
            stand.head.on_status = interrupt

    engine = stand.engine(listeners=[arm])
    outcome = engine.run(dwells(10.0))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, False)
    assert stand.head.stops > 0


def test_the_end_of_the_interpreter_passes_through_but_leaves_the_head_at_rest(stand: FakeStand):
    def leave():
        raise SystemExit(1)

    stand.daq.on_acquire = leave
    with pytest.raises(SystemExit):
        stand.engine().run(dwells(10.0))
    assert isinstance(stand.sink.events[-1], RunFinished)
    assert stand.sink.events[-1].at_standstill
