import math
from dataclasses import replace

import pytest
from fakes import FakeStand, point_at

from tumble.procedures.events import FinishReason, PointVerified, RunResumed
from tumble.procedures.methods.dividing_head.layout import dwell_at
from tumble.procedures.methods.dividing_head.rows import row_of
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.steps import Reading
from tumble.procedures.verification import allowed

SWEEP = programme_from_text('name = "a"\n[[procedure]]\nkind = "sweep"\nstep_deg = 30\npoints = 4\n', "a.toml")
DWELL = dwell_at(angle_deg=5.0, procedure="sweep", realisation=1, mount="face-up")
NOW = Reading(mean=2.5, sd=1e-3, samples=10)


def off_by(point, volts_v):
    row = row_of(point)
    return replace(row, voltage_v=row.voltage_v + volts_v).point


def begun(points=3):
    return FakeStand().engine().run(SWEEP.procedure).points[:points]


def test_five_standard_deviations_of_the_difference_are_allowed():
    points = [replace(row_of(point_at(DWELL, 2.5)), voltage_sd_v=1e-3).point]
    assert allowed(points, "voltage_v", NOW, 0.01) == pytest.approx(5 * 1e-3 * math.sqrt(2 / 10))


def test_where_the_head_may_stand_elsewhere_the_output_may_differ_accordingly():
    points = [replace(row_of(point_at(DWELL, voltage_v)), voltage_sd_v=0.0).point for voltage_v in (1.5, 3.5)]
    still = replace(NOW, sd=0.0)
    assert allowed(points, "voltage_v", still, 0.01) == pytest.approx(math.radians(0.01))


def test_the_last_point_is_taken_again_and_neither_lost_nor_doubled(stand: FakeStand):
    points = begun()
    outcome = stand.engine().resume(SWEEP.procedure, points)
    (seen,) = stand.sink.of(PointVerified)
    assert (seen.point, seen.now, seen.recorded) == (
        2,
        pytest.approx(points[2].readings["voltage_v"].mean),
        points[2].readings["voltage_v"].mean,
    )
    assert stand.sink.of(RunResumed) == [RunResumed(points=3)]
    assert [point.index for point in outcome.points] == [0, 1, 2, 3]
    assert outcome.points[:3] == points


def test_the_head_is_homed_before_the_last_point_is_taken_again(stand: FakeStand):
    stand.engine().resume(SWEEP.procedure, begun())
    assert stand.head.targets_deg == [0.0, 60.0, 90.0]


def test_a_voltage_that_is_another_ends_the_run_before_it_goes_on(stand: FakeStand):
    points = begun()
    changed = (*points[:2], off_by(points[2], 0.02))
    outcome = stand.engine().resume(SWEEP.procedure, changed)
    assert (outcome.reason, outcome.points, outcome.at_standstill) == (FinishReason.DEVICE_FAULT, changed, True)
    assert outcome.message.startswith(
        "stand: point 2 gives 1.633975 V now and gave 1.653975 V before the interruption, where 0.0024 V is the most "
        "that noise explains; look whether the unit, its mount or its wiring has changed"
    )
    assert stand.sink.of(RunResumed) == []


def test_who_knows_that_only_the_room_has_changed_may_allow_more(stand: FakeStand):
    points = begun()
    changed = (*points[:2], off_by(points[2], 0.02))
    outcome = stand.engine().resume(SWEEP.procedure, changed, tolerance_v=0.05)
    assert outcome.reason is FinishReason.COMPLETED


def test_a_last_point_without_a_voltage_cannot_be_compared(stand: FakeStand):
    points = begun()
    bad = (*points[:2], off_by(points[2], math.nan))
    outcome = stand.engine().resume(SWEEP.procedure, bad)
    assert (outcome.reason, stand.sink.of(PointVerified)) == (FinishReason.COMPLETED, [])


def test_an_overload_now_is_no_agreement(stand: FakeStand):
    stand.daq.overload_at = {2}
    outcome = stand.engine().resume(SWEEP.procedure, begun())
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert "point 2 gives nan V now" in outcome.message
