"""A run that shakes: levels by ramps and read back, and the drive at zero in whatever way it ends."""

from itertools import pairwise

import pytest
from shaken_stand import LOST, ShakenStand, fail

from tumble.app.exits import Exit
from tumble.app.running import FINISHED
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.excitation import REST, excitation_of
from tumble.drivers.protocols import ExciterStatus, Identity
from tumble.procedures.errors import StorageError
from tumble.procedures.events import ConditionAnswered, FinishReason, PointCompleted, RunResumed

BACK = "sine 4 g 21.3 Hz"


@pytest.fixture
def shaken(tmp_path):
    return ShakenStand(tmp_path)


def says(text, on=True, overload=False):
    return lambda _call: ExciterStatus(excitation=excitation_of(text), on=on, overload=overload)


def test_rest_vibration_rest_in_each_mounting(shaken):
    outcome = shaken.run()
    assert outcome.reason is FinishReason.COMPLETED, outcome.message
    assert [point.conditions["exciter"] for point in outcome.points] == ["rest", BACK, "rest"] * 2
    assert [ask.condition for ask in shaken.operator.asked] == ["mount", "mount"]
    assert shaken.driven == "rest"


def test_a_level_is_reached_by_a_ramp_and_left_by_one(shaken):
    levels = []
    usual = shaken.world.exciter.set

    def note(excitation, *, on):
        levels.append((shaken.clock.monotonic_s(), excitation.tones[0].level_g if excitation != REST else 0.0))
        usual(excitation, on=on)

    shaken.world.exciter.set = note
    shaken.run()
    up = [level for _, level in levels[2:12]]
    assert max(abs(second - first) for first, second in pairwise(up)) < 0.2 * 4.0
    seconds = [time_s for time_s, level in levels if 0.0 < level < 4.0]
    assert 1.0 < seconds[6] - seconds[0] < 2.5


def test_nobody_is_asked_while_the_unit_is_shaken(shaken):
    seen = []
    usual = shaken.operator.ask
    shaken.operator.ask = lambda ask: (seen.append(shaken.driven), usual(ask))
    shaken.run()
    assert seen == ["rest", "rest"]


def test_while_it_pauses_nothing_shakes_and_then_it_goes_on(shaken):
    seen, control = [], shaken.engine.control
    shaken.while_shaking(control.pause)
    usual = shaken.clock.sleep

    def sleep(duration_s):
        usual(duration_s)
        if shaken.engine.state.name == "PAUSED":
            seen.append(shaken.driven)
            control.resume()

    shaken.clock.sleep = sleep
    outcome = shaken.run()
    assert (outcome.reason, len(outcome.points), seen) == (FinishReason.COMPLETED, 6, ["rest"])


def lost_in_a_dwell(it):
    it.while_shaking(lambda: it.exciter.instead("status", fail(LOST)))


def lost_on_the_ramp(it):
    it.exciter.instead("drive", fail(LOST), after=3)


def power_lost(it):
    it.while_shaking(lambda: it.world.exciter.set(REST, on=False))


def daq_lost(it):
    error = LinkLostError("DAQ", "is gone", "look")
    it.while_shaking(lambda: it.daq.instead("acquire", fail(error)))


@pytest.mark.parametrize("fault", [lost_in_a_dwell, lost_on_the_ramp, power_lost, daq_lost])
def test_what_is_back_goes_on_and_every_point_comes_once(fault, shaken):
    fault(shaken)
    outcome = shaken.run()
    assert outcome.reason is FinishReason.COMPLETED, outcome.message
    assert [point.index for point in outcome.points] == list(range(6))
    assert outcome.points[1].readings["output_v"].sd > 2.0
    assert "the step is repeated" in " ".join(shaken.warnings)
    assert shaken.driven == "rest"


def test_where_another_link_is_lost_it_rests_meanwhile(shaken):
    seen = []
    error = LinkLostError("DAQ", "is gone", "look")
    shaken.while_shaking(lambda: shaken.daq.instead("acquire", fail(error)))
    shaken.daq.instead("identify", lambda call: (seen.append(shaken.driven), call())[1], times=9)
    shaken.run()
    assert seen == ["rest", "rest"]


def silent(it):
    it.while_shaking(lambda: it.exciter.instead("status", fail(NoReplyError("exciter", "is silent", "look"))))


def refused(it):
    it.exciter.instead("drive", fail(DeviceError("exciter", "refuses (-222)", "look")), after=2)


def other_level(it):
    it.while_shaking(lambda: it.exciter.instead("status", says("sine 3 g 21.3 Hz")))


def other_frequency(it):
    it.while_shaking(lambda: it.exciter.instead("status", says("sine 4 g 22 Hz")))


def overload_on_the_ramp(it):
    it.exciter.instead("status", says(BACK, overload=True), after=6)


def overload_in_a_dwell(it):
    it.while_shaking(lambda: it.exciter.instead("status", says(BACK, overload=True)))


def driven_by_somebody(it):
    it.exciter.instead("status", says("sine 1 g 50 Hz"), after=2)


def shakes_too_much(it):
    it.stand.most["reference_x_v"] = 0.3


def shakes_too_much_in_a_dwell(it):
    it.while_shaking(lambda: it.stand.most.update(reference_x_v=0.3))


def another_generator(it):
    def swap():
        it.exciter.instead("status", fail(LOST))
        it.exciter.instead("identify", lambda _call: Identity(model="another", serial="2"))

    it.while_shaking(swap)


def daq_gone(it):
    error = LinkLostError("DAQ", "is gone", "look")
    it.while_shaking(lambda: (it.daq.instead("acquire", fail(error)), it.daq.instead("reconnect", fail(error), 10**6)))


def unanswered(it):
    it.operator.answers = {"x along o, y along p, p down": "no"}


def stopped_on_the_ramp(it):
    it.exciter.instead("drive", lambda call: (it.engine.control.stop(), call())[1], after=2)


def stopped_in_a_dwell(it):
    it.while_shaking(it.engine.control.stop)


def interrupted(it):
    it.while_shaking(lambda: (_ for _ in ()).throw(KeyboardInterrupt))


def disk_full(it):
    usual = it.sink.record

    def record(event):
        if type(event).__name__ == "SamplesAcquired" and event.point == 1:
            raise StorageError("no room")
        usual(event)

    it.sink.record = record


def fault_of_the_program(it):
    it.while_shaking(lambda: 1 / 0)


ENDINGS = {
    silent: Exit.DEVICE_FAULT,
    refused: Exit.DEVICE_FAULT,
    other_level: Exit.DEVICE_FAULT,
    other_frequency: Exit.DEVICE_FAULT,
    overload_on_the_ramp: Exit.DEVICE_FAULT,
    overload_in_a_dwell: Exit.DEVICE_FAULT,
    driven_by_somebody: Exit.DEVICE_FAULT,
    shakes_too_much: Exit.DEVICE_FAULT,
    shakes_too_much_in_a_dwell: Exit.DEVICE_FAULT,
    another_generator: Exit.DEVICE_FAULT,
    daq_gone: Exit.DEVICE_FAULT,
    unanswered: Exit.BAD_INPUT,
    stopped_on_the_ramp: Exit.STOPPED,
    stopped_in_a_dwell: Exit.STOPPED,
    interrupted: Exit.STOPPED,
    disk_full: Exit.STORAGE,
    fault_of_the_program: Exit.INTERNAL,
}


@pytest.mark.parametrize(("fault", "status"), ENDINGS.items(), ids=lambda each: getattr(each, "__name__", ""))
def test_whatever_ends_it_the_drive_is_at_zero_and_read_back(fault, status, shaken):
    fault(shaken)
    outcome = shaken.run()
    assert FINISHED[outcome.reason] is status, outcome.message
    assert (shaken.driven, outcome.at_standstill) == ("rest", True)
    assert len(outcome.points) < 6


def gone_for_good(it):
    it.while_shaking(
        lambda: [it.exciter.instead(name, fail(LOST), 10**6) for name in ("status", "make_safe", "reconnect")]
    )


def stuck(it):
    it.while_shaking(lambda: setattr(it.world.exciter, "stuck", True))


@pytest.mark.parametrize("fault", [gone_for_good, stuck])
def test_where_it_cannot_be_brought_to_rest_the_operator_is_told_to_do_it(fault, shaken):
    fault(shaken)
    outcome = shaken.run()
    assert (FINISHED[outcome.reason], outcome.at_standstill) == (Exit.DEVICE_FAULT, False)
    assert "switch its amplifier off by hand before anybody touches the unit" in shaken.warnings[-1]
    assert "its standstill could not be read back" in outcome.message
    assert shaken.driven == BACK


def test_at_the_end_it_is_brought_to_rest_over_a_new_connection(shaken):
    shaken.while_shaking(lambda: (shaken.exciter.instead("make_safe", fail(LOST), 3), shaken.engine.control.stop()))
    outcome = shaken.run()
    assert (FINISHED[outcome.reason], outcome.at_standstill, shaken.driven) == (Exit.STOPPED, True, "rest")
    assert shaken.exciter.reconnects == 3


def test_what_a_killed_run_left_driving_is_brought_to_rest_before_anything_else(shaken):
    shaken.world.exciter.set(excitation_of(BACK), on=True)
    seen = []
    usual = shaken.operator.ask
    shaken.operator.ask = lambda ask: (seen.append(shaken.driven), usual(ask))
    shaken.run()
    assert seen[0] == "rest"


def test_what_is_left_driving_is_brought_to_rest_before_a_run_is_resumed(shaken, tmp_path):
    journal = shaken.run().points
    resumed = ShakenStand(tmp_path)
    resumed.world.exciter.set(excitation_of(BACK), on=True)
    seen = []
    usual = resumed.operator.ask
    resumed.operator.ask = lambda ask: (seen.append(resumed.driven), usual(ask))
    outcome = resumed.engine.resume(resumed.programme.procedure, journal[:1], tolerance_v=10.0)
    assert (outcome.reason, seen[0]) == (FinishReason.COMPLETED, "rest"), outcome.message


def test_a_stranger_at_the_address_is_told_nothing(shaken):
    shaken.exciter.instead("identify", fail(DeviceError("exciter", "is no generator", "look")))
    shaken.exciter.instead("make_safe", fail(AssertionError("told something")))
    outcome = shaken.run()
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, True)


@pytest.mark.parametrize("points", range(1, 6))
def test_a_run_that_was_cut_off_goes_on_at_every_point(points, tmp_path):
    whole = ShakenStand(tmp_path)
    journal = whole.run().points
    resumed = ShakenStand(tmp_path)
    outcome = resumed.engine.resume(resumed.programme.procedure, journal[:points], tolerance_v=10.0)
    assert outcome.reason is FinishReason.COMPLETED, outcome.message
    assert [point.index for point in outcome.points] == list(range(6))
    assert [event.points for event in resumed.sink.of(RunResumed)] == [points]
    assert resumed.driven == "rest"


def test_a_point_is_taken_again_under_the_vibration_that_it_was_taken_under(shaken):
    usual, wished = shaken.sink.record, []

    def record(event):
        usual(event)
        points = shaken.sink.of(PointCompleted)
        if isinstance(event, ConditionAnswered) and len(points) == 2 and not wished:
            wished.append(event.value)
            shaken.engine.control.take_again(1)

    shaken.sink.record = record
    outcome = shaken.run()
    assert outcome.reason is FinishReason.COMPLETED, outcome.message
    assert wished == ["rest"]
    answered = [event.value for event in shaken.sink.of(ConditionAnswered) if event.condition == "exciter"]
    assert answered[:4] == ["rest", BACK, "rest", BACK]
    assert answered[4] == "rest"
    assert [point.take for point in outcome.points] == [1, 2, 1, 1, 1, 1]
    assert [point.conditions["exciter"] for point in outcome.points] == ["rest", BACK, "rest"] * 2
    assert shaken.driven == "rest"


def test_where_the_references_still_shake_at_rest_nobody_is_asked_and_the_operator_is_told(shaken):
    said = []
    shaken.exciter.instead("make_safe", lambda _call: said.append("rests"), times=10**6, after=3)
    at_rest = ExciterStatus(excitation=REST, on=False)
    shaken.exciter.instead("status", lambda call: at_rest if said else call(), times=10**6)
    outcome = shaken.run()
    assert (FINISHED[outcome.reason], outcome.at_standstill) == (Exit.DEVICE_FAULT, False), outcome.message
    assert "says that it rests, and reference_x_v still shakes" in " ".join([outcome.message, *shaken.warnings])
    assert len(shaken.operator.asked) == 1
