import math
from dataclasses import replace

import pytest
from fake_runs import dwells, states
from fakes import QUICK, FakeStand

from tumble.drivers.errors import DeviceError
from tumble.procedures.errors import ProcedureError
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    FinishReason,
    Identified,
    PointCompleted,
    RunFinished,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.methods.dividing_head.layout import MOUNT, dwell_at, mounting
from tumble.procedures.methods.dividing_head.rows import Row, row_of
from tumble.procedures.operator import Answer
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.steps import Confirmed

FLIPS = 'name = "flips"\n[[procedure]]\nkind = "flip"\naxes = ["y", "z"]\n'


def flips():
    return programme_from_text(FLIPS, "flips.toml").procedure()


def test_a_run_announces_everything_in_its_order(stand: FakeStand):
    outcome = stand.engine().run(dwells(-90.0))
    assert [type(event) for event in stand.sink.events] == [
        StateChanged,
        Identified,
        Identified,
        StepStarted,
        StateChanged,
        ConditionRequested,
        ConditionAnswered,
        StateChanged,
        StepStarted,
        SamplesAcquired,
        PointCompleted,
        StateChanged,
        StateChanged,
        RunFinished,
    ]
    assert states(stand) == ["running", "awaiting operator", "running", "stopping", "standstill"]
    assert stand.sink.events[-1] == RunFinished(
        reason=FinishReason.COMPLETED, message="the programme was carried out", at_standstill=True
    )
    assert (outcome.reason, outcome.at_standstill, outcome.error) == (FinishReason.COMPLETED, True, None)


def test_a_point_is_the_mean_of_its_samples_with_time_direction_and_origin(stand: FakeStand):
    (point,) = stand.engine().run(dwells(-90.0)).points
    block = stand.sink.of(SamplesAcquired)[0]
    assert row_of(point) == Row(
        index=0,
        angle_deg=-90.0,
        voltage_v=pytest.approx(3.5),
        voltage_sd_v=pytest.approx(1e-3 * math.sqrt(10 / 9)),
        samples=10,
        time_s=pytest.approx(block.time_s + 0.05),
        direction=-1,
        temperature_degc=23.0,
        realisation=1,
        procedure="sweep",
        mount="face-up",
        settled=True,
    )


def test_times_count_from_the_beginning_of_the_run(stand: FakeStand):
    stand.clock.sleep(1000.0)
    (point,) = stand.engine().run(dwells(-90.0)).points
    assert point.time_s == pytest.approx(3.0 + 0.04 + 0.05, abs=0.06)  # the move, two blocks, half a dwell


def test_the_direction_is_that_of_the_last_real_move(stand: FakeStand):
    points = stand.engine().run(dwells(0.0, 30.0, 30.0, -10.0)).points
    assert [point.directions["head"] for point in points] == [0, 1, 1, -1]


def test_a_procedure_is_sent_the_reply_to_each_step(stand: FakeStand):
    replies = []

    def procedure():
        replies.append((yield mounting("edge")))
        replies.append((yield dwell_at(angle_deg=5.0, procedure="flip", realisation=1, mount="edge")))

    outcome = stand.engine().run(procedure)
    assert replies == [Confirmed(condition=MOUNT, value="edge"), outcome.points[0]]


def test_the_head_goes_where_the_programme_says(stand: FakeStand):
    stand.engine().run(flips)
    assert stand.head.targets_deg == [180.0, 0.0, 180.0, 0.0]
    assert stand.operator.asked == ["face-up", "edge"]


def test_an_empty_procedure_is_completed(stand: FakeStand):
    assert stand.engine().run(lambda: (dwell for dwell in ())).reason is FinishReason.COMPLETED


def test_a_point_with_an_overload_is_kept_without_a_voltage(stand: FakeStand):
    stand.daq.overload_at = {2}
    (point,) = stand.engine().run(dwells(-90.0)).points
    assert math.isnan(point.readings["voltage_v"].mean)
    assert [event.message for event in stand.sink.of(WarningRaised)] == [
        "point 0 (face-up at -90 deg): 1 of 10 samples are overloads or no numbers; the point will be set aside"
    ]


def test_an_output_that_never_settles_is_marked_and_kept(stand: FakeStand):
    stand.daq.creep_v = 0.1
    (point,) = stand.engine(replace(QUICK, settle_timeout_s=0.5)).run(dwells(-90.0)).points
    assert not point.settled
    assert [event.message for event in stand.sink.of(WarningRaised)] == [
        "point 0 (face-up at -90 deg): the output had not settled after 0.5 s; the point is kept and marked"
    ]


def test_the_operator_may_take_his_time(stand: FakeStand):
    stand.operator.looks = 100
    (point,) = stand.engine().run(dwells(0.0)).points
    assert point.time_s > 5.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("no", "the request to seat the unit in face-up was answered 'no'; seat it and resume the run"),
        ("", "the request to seat the unit in face-up was not answered; seat it and resume the run"),
    ],
)
def test_a_mount_that_is_not_confirmed_ends_the_run(stand: FakeStand, text, message):
    stand.operator.answer = Answer(text=text, confirmed=False)
    outcome = stand.engine().run(dwells(0.0))
    assert (outcome.reason, outcome.message) == (FinishReason.UNANSWERED, message)
    assert stand.sink.of(ConditionAnswered) == [
        ConditionAnswered(condition=MOUNT, value="face-up", answer=text, confirmed=False)
    ]
    assert stand.head.targets_deg == []


def test_a_head_that_does_not_arrive_is_a_device_fault(stand: FakeStand):
    stand.head.stuck_at_deg = -12.5
    outcome = stand.engine().run(dwells(-90.0))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, True)
    assert outcome.message == (
        "dividing head: stands at -12.5000 deg when it should long have stood at -90 deg; look for what blocks it, "
        "check its drive and speed, then resume the run"
    )


def test_an_incomplete_block_is_a_device_fault(stand: FakeStand):
    stand.daq.short_by = 1
    outcome = stand.engine().run(dwells(-90.0))
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert outcome.message.startswith("DAQ: gave 1 of 2 samples; ")


def test_a_device_fault_during_a_move_still_ends_in_a_standstill(stand: FakeStand):
    def fail_once():
        if stand.clock.monotonic_s() > 1.0:
            stand.head.on_status = lambda: None
            raise DeviceError("fake head", "does not answer", "check its cable")

    stand.head.on_status = fail_once
    outcome = stand.engine().run(dwells(90.0, 0.0))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, True)
    assert not stand.head.status().moving
    assert stand.head.status().angle_deg < 40.0


def test_a_head_that_misses_the_command_to_stop_is_told_again(stand: FakeStand):
    stand.head.deaf_stops = 3
    engine = stand.engine()
    stand.head.on_status = lambda: engine.control.stop() if stand.clock.monotonic_s() > 1.0 else None
    outcome = engine.run(dwells(90.0))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STOPPED, True)
    assert stand.head.stops == 4


def test_a_head_that_never_rests_is_said_to_move(stand: FakeStand):
    stand.head.coasting = True
    outcome = stand.engine().run(dwells(90.0))
    assert not outcome.at_standstill
    assert outcome.message.endswith(
        "dividing head: its standstill could not be read back; look at it before you touch it"
    )
    assert states(stand)[-1] is State.STOPPING


def test_without_a_standstill_no_run_is_completed(stand: FakeStand):
    def coast_at_the_end():
        yield from dwells(10.0)()
        stand.head.coasting = True

    outcome = stand.engine().run(coast_at_the_end)
    assert (outcome.reason, len(outcome.points)) == (FinishReason.DEVICE_FAULT, 1)


def test_an_exception_inside_a_procedure_is_a_fault_of_the_program(stand: FakeStand):
    def broken():
        yield from dwells(10.0)()
        raise ZeroDivisionError("by zero")

    outcome = stand.engine().run(broken)
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.INTERNAL, True)
    assert isinstance(outcome.error, ZeroDivisionError)
    assert outcome.message == "a fault of the program: ZeroDivisionError: by zero; report it, then resume the run"


def test_a_part_of_a_programme_that_is_told_nonsense_says_so():
    procedure = flips()
    procedure.send(None)
    procedure.send(Confirmed(condition=MOUNT, value="face-up"))
    with pytest.raises(ProcedureError, match=r"answered with Confirmed\(.*'face-up'\) in place of a point"):
        procedure.send(Confirmed(condition=MOUNT, value="face-up"))


def test_a_dwell_in_a_mount_that_nobody_confirmed_is_not_taken(stand: FakeStand):
    steps = (dwell_at(angle_deg=5.0, procedure="flip", realisation=1, mount=mount) for mount in ["edge"])
    outcome = stand.engine().run(lambda: steps)
    assert outcome.reason is FinishReason.INTERNAL
    assert stand.head.targets_deg == []


@pytest.mark.parametrize(
    ("kind", "points"), [(StateChanged, 0), (ConditionAnswered, 0), (SamplesAcquired, 0), (PointCompleted, 0)]
)
def test_a_sink_that_fails_ends_the_run(stand: FakeStand, kind, points):
    stand.sink.fails_at = lambda event: isinstance(event, kind)
    told = []
    outcome = stand.engine(listeners=[told.append]).run(dwells(10.0))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STORAGE, True)
    assert outcome.message == "the recording failed: No space left on device; then resume the run"
    assert len(outcome.points) == points
    assert isinstance(stand.sink.events[-1], RunFinished)
    assert told[-1] == stand.sink.events[-1]


def test_a_sink_that_fails_at_the_very_end_is_not_passed_over(stand: FakeStand):
    stand.sink.fails_at = lambda event: isinstance(event, RunFinished)
    told = []
    outcome = stand.engine(listeners=[told.append]).run(dwells(10.0))
    assert outcome.reason is FinishReason.STORAGE
    assert told[-1].reason is FinishReason.STORAGE


def test_a_sink_that_fails_at_the_end_does_not_hide_what_came_before(stand: FakeStand):
    stand.sink.fails_at = lambda event: isinstance(event, RunFinished)
    stand.head.stuck_at_deg = 3.0
    assert stand.engine().run(dwells(10.0)).reason is FinishReason.DEVICE_FAULT


def test_no_step_begins_before_the_point_before_it_is_safe(stand: FakeStand):
    stand.sink.fails_at = lambda event: isinstance(event, PointCompleted) and event.point.index == 1
    outcome = stand.engine().run(dwells(10.0, 20.0, 30.0))
    assert [point.index for point in outcome.points] == [0]
    assert stand.head.targets_deg == [10.0, 20.0]


def test_a_listener_that_fails_is_dropped_with_a_warning(stand: FakeStand):
    calls = []

    def broken(event):
        calls.append(event)
        raise RuntimeError("no display")

    told = []
    outcome = stand.engine(listeners=[broken, told.append]).run(dwells(10.0))
    assert outcome.reason is FinishReason.COMPLETED
    assert len(calls) == 1
    (warning,) = stand.sink.of(WarningRaised)
    assert "broken failed and is no longer served: RuntimeError: no display" in warning.message
    assert told == stand.sink.events
