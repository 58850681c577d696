"""The engine on two axes and three channels: nothing in it knows a dividing head."""

import math
from dataclasses import replace

import pytest
from fakes import QUICK, FakeDaq
from recording_examples import HEADER
from two_axes import CHANNELS, TwoAxesStand, dwell_at

from tumble.drivers.errors import LinkLostError
from tumble.drivers.protocols import Stand
from tumble.procedures.approach import Approach
from tumble.procedures.engine import Engine
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.events import ConditionAnswered, FinishReason, PointVerified, SamplesAcquired
from tumble.procedures.plan import plan
from tumble.procedures.plan_checks import check_limits
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.writer import Recorder
from tumble.procedures.steps import pose

PROGRAMME = """method = "two_axes"
name = "four"
[positions]
places_deg = [[90.0, 0.0], [90.0, 45.0], [0.0, 45.0], [-90.0, 30.0]]
"""


@pytest.fixture
def stand():
    return TwoAxesStand()


@pytest.fixture(autouse=True)
def installed(install):
    install("tumble.procedures", "two_axes", "two_axes:TWO_AXES")


@pytest.fixture
def programme(installed):
    return programme_from_text(PROGRAMME, "four.toml")


def test_a_point_has_both_positions_and_a_mean_of_every_channel(stand, programme):
    outcome = stand.engine().run(programme.procedure)
    assert outcome.reason is FinishReason.COMPLETED
    point = outcome.points[1]
    assert point.positions_deg == {"outer": 90.0, "inner": 45.0}
    assert point.directions == {"outer": 1, "inner": 1}
    half_v = -math.sqrt(0.5)
    assert {name: reading.mean for name, reading in point.readings.items()} == pytest.approx(
        {"u_x_v": half_v, "u_y_v": half_v, "u_z_v": 0.0}
    )
    assert point.conditions == {"base": "level"}


def test_both_axes_set_out_at_once(stand):
    (point,) = stand.engine().run(lambda: (dwell for dwell in [replace(dwell_at(90.0, 60.0), conditions={})])).points
    longer_move_s, two_blocks_s, half_a_dwell_s = 90.0 / 30.0, 0.04, 0.05
    assert point.time_s == pytest.approx(longer_move_s + two_blocks_s + half_a_dwell_s, abs=0.06)


def test_every_axis_is_approached_from_the_same_side(stand, programme):
    acquisition = replace(QUICK, approach=Approach(direction=1))
    stand.engine(acquisition).run(programme.procedure)
    assert stand.outer.targets_deg == [90.0, 90.0, -2.0, 0.0, -92.0, -90.0]
    assert stand.inner.targets_deg == [-2.0, 0.0, 45.0, 45.0, 28.0, 30.0]


def test_the_operator_is_asked_for_the_condition_once(stand, programme):
    stand.engine().run(programme.procedure)
    answered = ConditionAnswered(condition="base", value="level", answer="yes", confirmed=True)
    assert stand.sink.of(ConditionAnswered) == [answered]


@pytest.mark.parametrize("stuck", ["outer", "inner"])
def test_where_one_axis_is_stuck_both_are_brought_to_rest(stand, programme, stuck):
    getattr(stand, stuck).stuck_at_deg = 3.0
    outcome = stand.engine().run(programme.procedure)
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, True)
    assert outcome.message.startswith(f"{stuck} axis: ")
    assert stand.outer.stops
    assert stand.inner.stops


@pytest.mark.parametrize("deaf", ["outer", "inner"])
def test_an_axis_that_cannot_be_told_to_stop_leaves_no_other_moving(stand, deaf):
    engine = stand.engine()

    def stop():
        if stand.clock.monotonic_s() > 1.0:
            engine.control.stop()

    stand.outer.on_status = stop
    getattr(stand, deaf).deaf_stops = 1
    outcome = engine.run(lambda: (dwell for dwell in [replace(dwell_at(300.0, 300.0), conditions={})]))
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.STOPPED, True)
    assert not stand.outer.status().moving
    assert not stand.inner.status().moving


def test_an_axis_that_coasts_for_ever_is_no_standstill(stand, programme):
    engine = stand.engine()
    stand.inner.coasting = True
    outcome = engine.run(programme.procedure)
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, False)
    assert "outer axis or inner axis: its standstill could not be read back" in outcome.message


def test_only_the_axis_that_lost_its_power_is_homed_and_comes_back_to_its_place(stand, programme):
    def lose_power():
        if stand.inner.targets_deg == [0.0, 45.0]:  # on its way
            stand.inner.on_status, stand.inner.knows = (lambda: None), False

    stand.inner.on_status = lose_power
    outcome = stand.engine().run(programme.procedure)
    undisturbed = TwoAxesStand().engine().run(programme.procedure)
    assert outcome.reason is FinishReason.COMPLETED
    assert [point.positions_deg for point in outcome.points] == [point.positions_deg for point in undisturbed.points]
    assert stand.inner.targets_deg == [0.0, 45.0, 0.0, 0.0, 45.0, 45.0, 30.0]  # homed, back to its place, on its way
    assert stand.outer.targets_deg == [90.0, 90.0, 90.0, 0.0, -90.0]


def test_two_samplers_may_share_the_channels(stand, programme):
    stand.samplers["thermometer"] = FakeDaq(stand.clock, stand.outer)
    outcome = stand.engine().run(programme.procedure)
    assert list(outcome.points[0].readings) == list(CHANNELS)
    assert outcome.points[0].temperature_degc == 23.0
    assert len(stand.sink.of(SamplesAcquired)) == 8


def test_two_samplers_with_a_channel_of_one_name_are_refused(stand, programme):
    stand.samplers["again"] = stand.samplers["triad"]
    assert "two samplers with a channel u_x_v" in stand.engine().run(programme.procedure).message


def test_a_channel_that_no_sampler_gives_is_a_fault_of_the_stand(stand, programme):
    stand.samplers = {"daq": FakeDaq(stand.clock, stand.outer)}
    outcome = stand.engine().run(programme.procedure)
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert "gives no channel 'u_x_v', only voltage_v" in outcome.message


def test_a_plan_moves_the_axes_together_and_keeps_each_in_its_limits(programme):
    planned = plan(programme, QUICK, speeds_deg_s={"outer": 10.0, "inner": 5.0}, request_s=60.0)
    settled_s = QUICK.planned_settling_s + QUICK.dwell_s
    durations_s = [step.duration_s - settled_s for step in planned.steps[1:]]
    assert durations_s == pytest.approx([9.0, 9.0, 9.0, 9.0])
    assert planned.requests == 1
    with pytest.raises(ProgrammeError, match="goes to -90 deg, outside the outer's limits"):
        check_limits(planned, "outer", (-45.0, 90.0))
    check_limits(planned, "inner", (0.0, 45.0))


def test_a_stand_without_an_axis_of_the_programme_is_refused(programme):
    with pytest.raises(ProgrammeError, match="the position needs the positioner inner; the stand has head, outer"):
        plan(programme, QUICK, speeds_deg_s={"head": 10.0, "outer": 10.0})


def recorded(stand, programme, path):
    header = replace(HEADER, method="two_axes", method_version=2, format_version=4, programme_text=PROGRAMME)
    with Recorder(path, header, stand.clock) as recorder:
        return stand.engine(sink=recorder).run(programme.procedure)


def test_a_recording_says_its_method_and_comes_back(stand, programme, tmp_path):
    outcome = recorded(stand, programme, tmp_path / "run.mcap")
    recording = read_recording(tmp_path / "run.mcap")
    assert (recording.header.method, recording.header.method_version) == ("two_axes", 2)
    assert recording.points == outcome.points
    dwells = map(dwell_at, [90.0, 90.0, 0.0, -90.0], [0.0, 45.0, 45.0, 30.0])
    assert recording.steps == (programme.layout.ask("base", "level"), *dwells)
    assert recording.complete
    blocks = [event.block for event in iter_samples(tmp_path / "run.mcap")]
    assert [list(block.channels) for block in blocks] == [list(CHANNELS)] * 4


def test_a_run_that_was_cut_off_goes_on_and_every_channel_is_held_against_its_own(stand, programme, tmp_path):
    points = recorded(stand, programme, tmp_path / "run.mcap").points
    again = TwoAxesStand()
    outcome = again.engine().resume(programme.procedure, points[:3])
    assert outcome.reason is FinishReason.COMPLETED
    assert [seen.channel for seen in again.sink.of(PointVerified)] == list(CHANNELS)
    assert [point.positions_deg for point in outcome.points] == [point.positions_deg for point in points]


def test_another_mean_of_one_channel_ends_a_resumed_run(stand, programme):
    points = stand.engine().run(programme.procedure).points[:3]
    changed = {**points[2].readings, "u_y_v": replace(points[2].readings["u_y_v"], mean=0.02)}
    outcome = TwoAxesStand().engine().resume(programme.procedure, [*points[:2], replace(points[2], readings=changed)])
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert "now and gave 0.020000 V before" in outcome.message


@pytest.mark.parametrize(
    ("changes", "happened"),
    [
        ({"method": "three_axes"}, r"is of a method that is not installed here \(no method is called 'three_axes'"),
        ({"method_version": 3}, "is of version 3 of two_axes, and 2 is installed"),
    ],
)
def test_a_recording_of_a_method_that_is_not_there_is_refused(
    stand, programme, tmp_path, monkeypatch, changes, happened
):
    header = replace(HEADER, method="two_axes", format_version=4)
    path = tmp_path / "run.mcap"
    with Recorder(path, header, stand.clock):
        pass
    altered = replace(header, **changes)
    monkeypatch.setattr("tumble.procedures.recording.contents.header_from_strings", lambda *_: altered)
    with pytest.raises(RecordingError, match=happened):
        read_recording(path)


def test_a_programme_of_a_method_that_is_not_there_names_the_line():
    with pytest.raises(ProgrammeError, match=r"p\.toml, line 2: method: no method is called 'triads'; known are "):
        programme_from_text('name = "a"\nmethod = "triads"\n', "p.toml")


def test_a_link_that_is_lost_on_one_axis_is_awaited(stand, programme):
    class Pulled(type(stand.inner)):
        pulled = 0

        def start_move(self, angle_deg):
            if angle_deg == 45.0 and not self.pulled:
                self.pulled = 1
                raise LinkLostError("inner axis", "was lost", "plug it in")
            super().start_move(angle_deg)

        def reconnect(self):
            self.pulled += 1

    stand.inner = Pulled(stand.clock)
    stand.samplers = {"triad": type(stand.samplers["triad"])(stand.clock, stand.outer, stand.inner)}
    outcome = stand.engine().run(programme.procedure)
    assert (outcome.reason, stand.inner.pulled) == (FinishReason.COMPLETED, 2)
    assert len(outcome.points) == 4


def test_while_a_link_is_awaited_no_other_axis_goes_on(stand, programme):
    seen = []

    class Gone(type(stand.inner)):
        def start_move(self, angle_deg):
            if angle_deg == 30.0:  # while the outer axis turns, too
                raise LinkLostError("inner axis", "was lost", "plug it in")
            super().start_move(angle_deg)

        def reconnect(self):
            seen.append(stand.outer.status().moving)

    stand.inner = Gone(stand.clock)
    stand.samplers = {"triad": type(stand.samplers["triad"])(stand.clock, stand.outer, stand.inner)}
    stand.engine().run(programme.procedure)
    assert seen
    assert not any(seen)


@pytest.mark.parametrize(
    ("conditions", "positions_deg", "said"),
    [
        ({"mount": "edge"}, {"head": 30.0}, "edge at 30 deg"),
        ({}, {"head": 30.0}, "30 deg"),
        ({"base": "level"}, {"outer": 90.0, "inner": -45.0}, "level at outer 90 deg, inner -45 deg"),
        ({"fixture": "io", "axis": "up"}, {}, "io, up"),
    ],
)
def test_where_a_dwell_is_taken_is_said_in_few_words(conditions, positions_deg, said):
    assert pose(conditions, positions_deg) == said


def test_a_stand_that_moves_nothing_measures_and_is_at_rest(stand):
    still = Stand(name="shelf", positioners={}, samplers=stand.samplers, clock=stand.clock)
    dwell = replace(dwell_at(0.0, 0.0), targets_deg={}, conditions={})
    outcome = Engine(still, stand.operator, stand.sink, QUICK).run(lambda: (step for step in [dwell]))
    assert (outcome.reason, len(outcome.points)) == (FinishReason.COMPLETED, 1)
