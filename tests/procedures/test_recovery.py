import pytest
from fakes import QUICK, FakeStand
from linked_stand import LinkedDaq, LinkedHead

from tumble.drivers.errors import DeviceError, NoReplyError, ReferenceLostError
from tumble.procedures.events import FinishReason, Identified, PointCompleted, SamplesAcquired, WarningRaised
from tumble.procedures.methods.dividing_head.rows import row_of
from tumble.procedures.programmes import programme_from_text

SWEEP = programme_from_text(
    'name = "a"\n[[procedure]]\nkind = "sweep"\nstart_deg = 40\nstep_deg = -5\npoints = 4\n', "a"
)


@pytest.fixture
def linked() -> FakeStand:
    stand = FakeStand()
    stand.head = LinkedHead(stand.clock)
    stand.daq = LinkedDaq(stand.clock, stand.head)
    stand.operator.daq = stand.daq
    return stand


def voltages(outcome):
    rows = map(row_of, outcome.points)
    return [(row.index, row.angle_deg, row.direction, round(row.voltage_v, 9)) for row in rows]


def undisturbed():
    return voltages(FakeStand().engine().run(SWEEP.procedure))


def once_when(condition, do):
    """Do something the first time that a condition holds."""
    done = []

    def watch():
        if not done and condition():
            done.append(True)
            do()

    return watch


def warnings(stand):
    return [event.message for event in stand.sink.of(WarningRaised)]


def test_both_instruments_are_identified_before_anything_moves(linked: FakeStand):
    linked.engine().run(SWEEP.procedure)
    assert linked.sink.events[1:3] == [
        Identified(instrument="head", model="fake", serial="17", firmware="1.0"),
        Identified(instrument="daq", model="fake", serial="17", firmware="1.0"),
    ]


def test_an_instrument_that_the_stand_file_does_not_mean_is_refused_before_anything_moves(linked: FakeStand):
    outcome = linked.engine(serials={"head": "18", "daq": ""}).run(SWEEP.procedure)
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert outcome.message == (
        "dividing head: has the serial number 17, and the stand file says 18; connect the right one, or correct the "
        "stand file"
    )
    assert linked.head.targets_deg == []
    assert linked.operator.asked == []


@pytest.mark.parametrize("after_s", [0.5, 1.36, 1.45, 1.55, 1.7, 2.0])
def test_a_cable_of_the_head_that_is_pulled_and_comes_back_loses_and_doubles_nothing(linked: FakeStand, after_s):
    linked.head.on_status = once_when(lambda: linked.clock.monotonic_s() > after_s, lambda: linked.head.link.pull(5.0))
    outcome = linked.engine().run(SWEEP.procedure)
    assert outcome.reason is FinishReason.COMPLETED
    assert voltages(outcome) == undisturbed()
    assert [event.point.index for event in linked.sink.of(PointCompleted)] == [0, 1, 2, 3]
    assert [event.point for event in linked.sink.of(SamplesAcquired)] == [0, 1, 2, 3]
    assert (linked.head.homings, linked.head.link.reopened) == (1, 1)
    said, back = warnings(linked)
    assert said == "fake head: the port is gone; trying to go on"
    assert back.startswith("fake head: is back after ")
    assert back.endswith(" s; the step is repeated")


def test_a_cable_of_the_daq_does_not_have_the_head_homed(linked: FakeStand):
    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 7, lambda: linked.daq.link.pull(10.0))
    outcome = linked.engine().run(SWEEP.procedure)
    assert voltages(outcome) == undisturbed()
    assert linked.head.homings == 0
    assert [event.instrument for event in linked.sink.of(Identified)] == ["head", "daq"] * 2


def test_an_instrument_that_still_boots_is_waited_for(linked: FakeStand):
    linked.daq.link.silent = 0

    def pull():
        linked.daq.link.pull(1.0)
        linked.daq.link.silent = 3

    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 4, pull)
    assert voltages(linked.engine().run(SWEEP.procedure)) == undisturbed()


def test_a_link_that_stays_away_ends_the_run_within_its_time_and_keeps_the_points(linked: FakeStand):
    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 7, lambda: linked.daq.link.pull(1e9))
    outcome = linked.engine().run(SWEEP.procedure)
    assert (outcome.reason, len(outcome.points), outcome.at_standstill) == (FinishReason.DEVICE_FAULT, 2, True)
    assert outcome.message == (
        "fake DAQ: the port is gone, and did not come back within 30 s; check its power and its cable, then resume the "
        "run"
    )
    assert linked.clock.monotonic_s() < 60.0


def test_an_instrument_that_was_swapped_meanwhile_is_an_error(linked: FakeStand):
    def swap():
        linked.daq.link.pull(1.0)
        linked.daq.link.serial = "99"

    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 7, swap)
    outcome = linked.engine().run(SWEEP.procedure)
    assert outcome.message == (
        "DAQ: is fake number 99, and the run was begun with fake number 17; connect that one again, then resume the run"
    )
    assert len(outcome.points) == 2


def test_no_answer_on_a_link_that_stands_ends_the_run(linked: FakeStand):
    def fail():
        linked.daq.on_acquire = lambda: None
        raise NoReplyError("fake DAQ", "gave no answer", "check that it is on")

    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 7, fail)
    outcome = linked.engine().run(SWEEP.procedure)
    assert (outcome.reason, len(outcome.points)) == (FinishReason.DEVICE_FAULT, 2)


def test_a_link_that_is_lost_over_and_over_ends_the_run(linked: FakeStand):
    linked.daq.on_acquire = lambda: linked.daq.link.pull(0.0)
    outcome = linked.engine().run(SWEEP.procedure)
    assert outcome.message == (
        "fake DAQ: was lost 10 times in one step, the last time so: the port is gone; check the cable"
    )


def test_a_stop_ends_the_waiting_for_a_link(linked: FakeStand):
    engine = linked.engine()
    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 4, lambda: linked.daq.link.pull(1e9))
    sleep = linked.clock.sleep

    def stop_soon(duration_s):
        sleep(duration_s)
        if not linked.daq.link.open:
            engine.control.stop()

    linked.clock.sleep = stop_soon
    assert engine.run(SWEEP.procedure).reason is FinishReason.STOPPED


def test_a_head_without_a_reference_is_homed_before_the_first_dwell(linked: FakeStand):
    linked.head.referenced = False
    outcome = linked.engine().run(SWEEP.procedure)
    assert outcome.reason is FinishReason.COMPLETED
    assert linked.head.targets_deg[:2] == [0.0, 40.0]
    assert warnings(linked) == ["dividing head: has no reference; it is homed"]


def test_a_head_that_loses_its_power_under_way_is_homed_and_the_step_begins_anew(linked: FakeStand):
    def lose_power():
        linked.head.referenced = False

    linked.head.on_status = once_when(lambda: linked.clock.monotonic_s() > 1.5, lose_power)
    outcome = linked.engine().run(SWEEP.procedure)
    assert voltages(outcome) == undisturbed()
    assert linked.head.homings == 1


def test_turns_of_the_cable_that_nobody_counts_any_more_are_told(linked: FakeStand):
    def lose_power():
        linked.head.referenced = False

    text = 'name = "a"\n[[procedure]]\nkind = "sweep"\nstart_deg = 700\nstep_deg = -5\npoints = 2\n'
    linked.daq.on_acquire = once_when(lambda: len(linked.sink.of(PointCompleted)) == 1, lose_power)
    outcome = linked.engine().run(programme_from_text(text, "a").procedure)
    assert [point.positions_deg["head"] for point in outcome.points] == [700.0, 695.0]
    assert warnings(linked)[1] == (
        "dividing head: has lost its reference at 700 deg; look whether its cable is wound by 2 turns, and stop the "
        "run to unwind it by hand if it is"
    )


def test_a_head_that_has_lost_its_power_when_it_is_told_to_move_is_homed_and_the_step_begins_anew(linked: FakeStand):
    start_move, moves = linked.head.start_move, []

    def lose_power(angle_deg):
        moves.append(angle_deg)
        if len(moves) == 3:
            linked.head.referenced = False
            raise ReferenceLostError("fake head", "has lost its reference", "home it before it is moved")
        start_move(angle_deg)

    linked.head.start_move = lose_power
    outcome = linked.engine().run(SWEEP.procedure)
    assert voltages(outcome) == undisturbed()
    assert linked.head.homings == 1


def test_a_head_that_never_finds_its_reference_ends_the_run(linked: FakeStand):
    linked.head.referenced = False
    linked.head.home = lambda: None
    outcome = linked.engine().run(SWEEP.procedure)
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert "was told to find its reference, and has not found it in time" in outcome.message
    assert linked.clock.monotonic_s() < 400.0


def test_a_wall_clock_that_is_set_back_changes_nothing(linked: FakeStand):
    wall = iter(range(10**18, 0, -(10**15)))
    linked.clock.wall_ns = lambda: next(wall)
    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 7, lambda: linked.daq.link.pull(10.0))
    outcome = linked.engine(QUICK).run(SWEEP.procedure)
    assert voltages(outcome) == undisturbed()
    times_s = [point.time_s for point in outcome.points]
    assert times_s == sorted(times_s)
    assert times_s[-1] < 60.0


def test_a_head_that_an_earlier_run_left_in_fault_is_reset_before_it_moves(linked: FakeStand):
    left = ["following error"]
    linked.head.referenced = False
    linked.head.reset_fault = lambda: left.pop() if left else ""

    def refuse_in_fault():
        if left:
            raise DeviceError("fake head", "is in fault", "reset it")

    linked.head.on_status = refuse_in_fault
    outcome = linked.engine().run(SWEEP.procedure)

    assert outcome.reason is FinishReason.COMPLETED
    assert warnings(linked) == [
        "dividing head: was left in fault by following error; the fault is reset",
        "dividing head: has no reference; it is homed",
    ]


def test_a_fault_whose_cause_is_still_there_ends_the_run_before_anything_moves(linked: FakeStand):
    def refuse():
        raise DeviceError("fake head", "reports following error", "remove the cause, then resume the run")

    linked.head.reset_fault = refuse
    outcome = linked.engine().run(SWEEP.procedure)

    assert (outcome.reason, outcome.points) == (FinishReason.DEVICE_FAULT, ())
    assert outcome.message == "fake head: reports following error; remove the cause, then resume the run"
    assert linked.head.targets_deg == []


def test_a_fault_under_way_is_not_reset(linked: FakeStand):
    resets = []
    linked.head.reset_fault = lambda: resets.append(linked.clock.monotonic_s()) or ""
    linked.head.on_status = once_when(lambda: linked.clock.monotonic_s() > 1.5, lambda: linked.head.link.pull(5.0))

    assert linked.engine().run(SWEEP.procedure).reason is FinishReason.COMPLETED
    assert len(resets) == 1


@pytest.mark.parametrize("name", ["head", "daq"])
def test_a_cable_that_is_pulled_while_the_instruments_are_identified_is_waited_for(linked: FakeStand, name):
    instrument = getattr(linked, name)
    instrument.link.pull(3.0)
    outcome = linked.engine().run(SWEEP.procedure)
    assert voltages(outcome) == undisturbed()
    assert linked.head.homings == (1 if name == "head" else 0)


def test_a_cable_that_is_pulled_while_the_head_is_homed_for_the_first_time_is_waited_for(linked: FakeStand):
    linked.head.referenced = False
    linked.head.on_status = once_when(lambda: linked.head.homings == 1, lambda: linked.head.link.pull(3.0))
    assert voltages(linked.engine().run(SWEEP.procedure)) == undisturbed()


def test_an_instrument_that_is_not_there_when_the_run_begins_ends_it_within_its_time(linked: FakeStand):
    linked.daq.link.pull(1e9)
    outcome = linked.engine().run(SWEEP.procedure)
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, True)
    assert "did not come back within 30 s; check its power and its cable" in outcome.message
    assert linked.clock.monotonic_s() < 45.0


def test_a_standstill_is_read_back_also_where_the_link_was_lost_when_the_run_was_stopped(linked: FakeStand):
    engine = linked.engine()

    def stop():
        engine.control.stop()
        linked.head.link.pull(1.0)

    linked.daq.on_acquire = once_when(lambda: linked.daq.blocks == 7, stop)
    outcome = engine.run(SWEEP.procedure)

    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STOPPED, True)


def test_an_interrupt_while_the_head_comes_to_rest_to_be_homed_is_no_device_fault(linked: FakeStand):
    linked.head.referenced = False

    def interrupt():
        raise KeyboardInterrupt

    linked.head.on_status = once_when(lambda: linked.head.stops == 1, interrupt)
    outcome = linked.engine().run(SWEEP.procedure)

    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STOPPED, True)


def test_what_an_instrument_put_right_is_told_after_the_step_and_when_the_run_ends(linked: FakeStand):
    said = iter([["DAQ: cut frames dropped: 1"], ["DAQ: cut frames dropped: 10"]])
    linked.daq.remarks = lambda: next(said, [])
    linked.daq.last_remarks = lambda: ["DAQ: cut frames dropped: 12"]
    outcome = linked.engine().run(SWEEP.procedure)
    assert outcome.reason is FinishReason.COMPLETED
    assert warnings(linked) == [f"DAQ: cut frames dropped: {count}" for count in (1, 10, 12)]
