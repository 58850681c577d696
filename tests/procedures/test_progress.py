import math

import pytest
from fakes import QUICK, FakeStand, point_at

from tumble.drivers.clock import VirtualClock
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.events import ConditionAnswered, PointCompleted, RetakeBegun, State, StateChanged, StepStarted
from tumble.procedures.methods.dividing_head.layout import MOUNT, dwell_at, mounting
from tumble.procedures.plan import plan
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.progress import Progress, TimeLeft

PROGRAMME = programme_from_text('name = "a"\n[[procedure]]\nkind = "sweep"\nstep_deg = 0\npoints = 5\n', "a.toml")
# One dwell is planned to take 10 s, the mounting 60 s.
PLAN = plan(
    PROGRAMME, Acquisition(samples=80, rate_hz=10.0, settle_samples=10), speeds_deg_s={"head": 1.0}, request_s=60.0
)
DWELL = dwell_at(angle_deg=0.0, procedure="sweep", realisation=1, mount="face-up")


class Run:
    """Plays events to a progress display."""

    def __init__(self, planned=PLAN, points_done=0):
        self.clock = VirtualClock(0)
        self.progress = Progress(planned, self.clock, points_done)

    def dwell(self, duration_s):
        self.progress(StepStarted(step=DWELL))
        self.clock.sleep(duration_s)
        self.progress(PointCompleted(point=point_at(DWELL)))

    def mounting(self, duration_s):
        self.progress(StepStarted(step=mounting("face-up")))
        self.clock.sleep(duration_s)
        self.progress(ConditionAnswered(condition=MOUNT, value="face-up", answer="yes", confirmed=True))

    def pause(self, duration_s):
        self.progress(StateChanged(state=State.PAUSED))
        self.clock.sleep(duration_s)
        self.progress(StateChanged(state=State.RUNNING))


def test_before_anything_is_done_the_plan_counts_and_nothing_is_sure():
    run = Run()
    assert (run.progress.done, run.progress.total) == (0, 5)
    assert run.progress.time_left() == TimeLeft(
        time_s=pytest.approx(110.0), standard_error_s=pytest.approx(math.hypot(50.0, 60.0))
    )


def test_the_time_left_follows_the_ratio_of_actual_to_planned_time():
    run = Run()
    run.mounting(5.0)
    run.dwell(11.0)
    run.dwell(13.0)
    left = run.progress.time_left()
    assert run.progress.done == 2
    assert left.time_s == pytest.approx(1.2 * 30.0)
    # s² = ((11 - 12)² + (13 - 12)²) / 10 / 1 = 0.2 s; variance = 0.2 · 30 + 0.2 · 30² / 20
    assert left.standard_error_s == pytest.approx(math.sqrt(6.0 + 9.0))


def test_an_even_pace_leaves_no_doubt():
    run = Run()
    run.mounting(60.0)
    for _ in range(3):
        run.dwell(20.0)
    assert run.progress.time_left() == TimeLeft(
        time_s=pytest.approx(40.0), standard_error_s=pytest.approx(0.0, abs=1e-5)
    )


def test_a_pause_is_not_counted():
    run = Run()
    run.mounting(60.0)
    run.progress(StepStarted(step=DWELL))
    run.clock.sleep(4.0)
    run.pause(1000.0)
    run.clock.sleep(6.0)
    run.progress(PointCompleted(point=point_at(DWELL)))
    assert run.progress.time_left().time_s == pytest.approx(40.0)


def test_a_resumed_run_counts_what_was_there_and_not_the_mount_confirmed_again():
    run = Run(points_done=3)
    run.progress(ConditionAnswered(condition=MOUNT, value="face-up", answer="yes", confirmed=True))
    run.dwell(10.0)
    assert (run.progress.done, run.progress.total) == (4, 5)
    assert run.progress.time_left().time_s == pytest.approx(10.0)


def test_steps_planned_to_take_no_time_say_nothing():
    run = Run(plan(PROGRAMME, QUICK, speeds_deg_s={"head": 1.0}, request_s=0.0))
    run.mounting(100.0)
    assert run.progress.time_left().time_s == pytest.approx(5 * 0.14)


def test_at_the_end_of_a_real_run_no_time_is_left(stand: FakeStand):
    progress = Progress(plan(PROGRAMME, QUICK, speeds_deg_s={"head": 30.0}), stand.clock)
    stand.engine(listeners=[progress]).run(PROGRAMME.procedure)
    assert (progress.done, progress.time_left()) == (5, TimeLeft(time_s=0.0, standard_error_s=0.0))


def test_a_point_that_is_taken_again_is_no_step_of_the_programme(stand: FakeStand):
    progress, wished = Progress(PLAN, stand.clock), []

    def wish(event):
        if isinstance(event, PointCompleted) and event.point.take == 1:
            wished.append(event.point.index)
            engine.control.take_again(event.point.index)

    engine = stand.engine(listeners=[progress, wish])
    engine.run(PROGRAMME.procedure)
    assert progress.done == progress.total == len(wished)
    assert progress.time_left().time_s == 0.0


def test_a_mount_that_gives_way_to_the_one_of_the_point_is_still_to_come(stand: FakeStand):
    text = 'name = "a"\n' + "".join(
        f'[[procedure]]\nkind = "sweep"\nmount = "{mount}"\nstep_deg = 5\npoints = 2\n' for mount in ("face-up", "end")
    )
    programme = programme_from_text(text, "a.toml")
    planned = plan(programme, QUICK, speeds_deg_s={"head": 30.0}, request_s=60.0)
    progress, left_s = Progress(planned, stand.clock), []
    stand.operator.looks = 5

    def hear(event):
        if isinstance(event, ConditionAnswered) and event.value == "end" and not left_s:
            left_s.append(progress.time_left().time_s)
            engine.control.take_again(1)
        elif isinstance(event, RetakeBegun):
            left_s.append(progress.time_left().time_s)

    engine = stand.engine(listeners=[progress, hear])
    engine.run(programme.procedure)
    assert left_s[1] > left_s[0]
    assert progress.time_left() == TimeLeft(time_s=0.0, standard_error_s=0.0)
