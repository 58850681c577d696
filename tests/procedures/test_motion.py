import pytest
from fakes import FakeHead, FakeStand

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import DeviceError
from tumble.procedures.approach import EITHER_WAY, Approach, Place
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.motion import Motion
from tumble.procedures.plan import plan
from tumble.procedures.plan_checks import check_cable, check_limits
from tumble.procedures.programmes import programme_from_text

HERE = Place(angle_deg=10.0, direction=1)


def going_on():
    return False


def head_and_motion(approach=None):
    clock = VirtualClock()
    head = FakeHead(clock)
    return head, Motion(head, clock, 0.01, approach or EITHER_WAY, title="dividing head")


@pytest.mark.parametrize(
    ("direction", "angle_deg", "waypoints_deg"),
    [
        (0, 20.0, (20.0,)),
        (0, 0.0, (0.0,)),
        (1, 20.0, (20.0,)),
        (1, 0.0, (-3.0, 0.0)),
        (-1, 20.0, (23.0, 20.0)),
        (-1, 0.0, (0.0,)),
        (1, 10.0, (10.0,)),
        (-1, 10.0, (13.0, 10.0)),
    ],
)
def test_an_angle_is_passed_where_the_head_would_come_from_the_wrong_side(direction, angle_deg, waypoints_deg):
    approach = Approach(direction=direction, overshoot_deg=3.0)
    assert approach.waypoints_deg(HERE, angle_deg, 0.01) == waypoints_deg


def test_a_programme_with_an_approach_arrives_everywhere_in_that_direction(stand: FakeStand):
    text = 'name = "a"\napproach = "up"\n[[procedure]]\nkind = "sweep"\nstep_deg = -10\npoints = 4\n'
    programme = programme_from_text(text, "a.toml")
    outcome = stand.engine(programme.acquisition(samples=10, rate_hz=100.0)).run(programme.procedure)
    assert [point.directions["head"] for point in outcome.points] == [1, 1, 1, 1]
    assert stand.head.targets_deg == [-2.0, 0.0, -12.0, -10.0, -22.0, -20.0, -32.0, -30.0]


def test_without_one_the_head_goes_straight(stand: FakeStand):
    programme = programme_from_text('name = "a"\n[[procedure]]\nkind = "sweep"\nstep_deg = -10\npoints = 3\n', "a.toml")
    stand.engine(programme.acquisition(samples=10, rate_hz=100.0)).run(programme.procedure)
    assert stand.head.targets_deg == [0.0, -10.0, -20.0]


def planned(text, **settings):
    programme = programme_from_text(text, "a.toml")
    return plan(programme, programme.acquisition(samples=100, rate_hz=100.0), speeds_deg_s={"head": 10.0}, **settings)


DOWN = 'name = "a"\napproach = "down"\novershoot_deg = 5\n[[procedure]]\nkind = "sweep"\nstep_deg = 10\npoints = 3\n'


def test_the_way_round_is_in_the_plan_and_within_the_limits():
    whole = planned(DOWN)
    straight = planned(DOWN.replace("down", "up"))
    # up: one detour of twice 5 deg for the first dwell; down: one for every dwell
    assert whole.duration_s - straight.duration_s == pytest.approx(2 * 2 * 0.5)
    check_limits(whole, "head", (0.0, 25.0))
    with pytest.raises(
        ProgrammeError, match=r"line 4: the sweep goes to 25 deg on its way to 20 deg, outside the head's"
    ):
        check_limits(whole, "head", (0.0, 24.0))


def test_a_cable_allows_what_the_limits_do_to_the_last_degree():
    check_cable(
        planned('name = "a"\n[[procedure]]\nkind = "sweep"\nstep_deg = 185\npoints = 2\n'), "head", 185.0 / 360.0
    )


def test_a_plan_that_winds_the_cable_too_far_is_refused():
    wound = planned('name = "a"\n[[procedure]]\nkind = "sweep"\nstep_deg = 90\npoints = 9\n')
    check_cable(wound, "head", 2.0)
    with pytest.raises(ProgrammeError) as raised:
        check_cable(wound, "head", 1.5)
    assert str(raised.value) == (
        "a.toml, line 2: the sweep goes to 630 deg, and the cable allows 1.5 turns to either side of zero; change the "
        "angles, or cable_turns of the stand"
    )


@pytest.mark.parametrize(("last_deg", "rest_deg"), [(395.0, 35.0), (-350.0, 10.0), (720.0, 0.0), (170.0, 170.0)])
def test_a_cable_that_was_wound_is_unwound_at_the_end(stand: FakeStand, last_deg, rest_deg):
    text = f'name = "a"\n[[procedure]]\nkind = "sweep"\nstart_deg = {last_deg}\nstep_deg = 0\npoints = 1\n'
    outcome = stand.engine().run(programme_from_text(text, "a.toml").procedure)
    assert [point.positions_deg["head"] for point in outcome.points] == [last_deg]
    assert stand.head.status().angle_deg == rest_deg


@pytest.mark.parametrize(("limits_deg", "rest_deg"), [((-10.0, 760.0), 200.0), ((-180.0, 760.0), -160.0)])
def test_a_cable_is_unwound_as_far_as_the_limits_allow(limits_deg, rest_deg):
    head, motion = head_and_motion()
    head.limits_deg = limits_deg
    motion.travel(560.0, going_on)
    motion.unwind(going_on)
    assert head.status().angle_deg == rest_deg


def test_a_head_that_knows_its_angle_unwinds_its_cable_before_it_is_homed():
    head, motion = head_and_motion()
    motion.travel(730.0, going_on)
    motion.home(going_on)
    assert head.targets_deg == [730.0, 10.0, 0.0]


def test_a_head_that_does_not_know_its_angle_is_homed_from_where_it_stands():
    head, motion = head_and_motion()
    motion.travel(730.0, going_on)
    head.knows = False
    motion.home(going_on)
    assert head.targets_deg == [730.0, 0.0]


def test_a_head_that_stalls_is_noticed_at_once():
    head, motion = head_and_motion()
    head.stuck_at_deg = 3.0
    with pytest.raises(DeviceError, match=r"stands at 3\.0000 deg when it should long have stood at 300 deg"):
        motion.travel(300.0, going_on)
    assert head._clock.monotonic_s() < 3.0  # a tenth of a second for the way, and the time to notice


def test_a_head_that_overshoots_is_noticed():
    head, motion = head_and_motion()
    head.stuck_at_deg = 31.0
    with pytest.raises(DeviceError, match=r"stands at 31\.0000 deg when it should long have stood at 30 deg"):
        motion.travel(30.0, going_on)


def test_a_head_that_says_for_ever_that_it_moves_is_not_waited_for_any_longer():
    head, motion = head_and_motion()
    head.coasting = True
    with pytest.raises(DeviceError, match=r"still moves at 30\.0000 deg when it should long have stood at 30 deg"):
        motion.travel(30.0, going_on)
    assert head._clock.monotonic_s() < 8.0


def test_a_head_that_does_not_get_on_is_noticed_long_before_the_end_of_a_long_way():
    head, motion = head_and_motion()
    head.speed_deg_s = 1.0
    head.coasting, head.stuck_at_deg = True, 2.0
    with pytest.raises(DeviceError, match=r"still moves at 2\.0000 deg when it should long have stood at 300 deg"):
        motion.travel(300.0, going_on)
    assert head._clock.monotonic_s() < 8.0  # two seconds of way, and the time to notice


def test_a_slow_head_that_gets_on_is_waited_for():
    head, motion = head_and_motion()
    head.speed_deg_s = 1e-3
    assert motion.travel(0.1, going_on).angle_deg == 0.1


@pytest.mark.parametrize("astray_deg", [-20.0, 50.0])
def test_a_head_that_leaves_its_way_is_stopped_at_once(astray_deg):
    head, motion = head_and_motion()
    head.stuck_at_deg = astray_deg
    with pytest.raises(DeviceError, match=r"is at -?\d+\.\d+ deg on its way from 0 to 30 deg"):
        motion.travel(30.0, going_on)
    assert head._clock.monotonic_s() < 1.2


def test_a_head_that_is_turned_during_a_dwell_ends_the_run(stand: FakeStand):
    def nudge():
        stand.head.start_move(12.0)
        stand.clock.sleep(1.0)

    stand.daq.on_acquire = lambda: nudge() if stand.daq.blocks == 2 else None
    text = 'name = "a"\n[[procedure]]\nkind = "sweep"\nstart_deg = 10\nstep_deg = 5\npoints = 2\n'
    outcome = stand.engine().run(programme_from_text(text, "a.toml").procedure)
    assert outcome.points == ()
    assert outcome.message == (
        "dividing head: was to stand at 10 deg for a dwell, and is at 12.0000 deg after it; look for what turns it, "
        "then resume the run"
    )


@pytest.mark.parametrize(("direction", "targets_deg"), [(1, [30.0]), (-1, [32.0, 30.0]), (0, [30.0])])
def test_a_place_is_gone_back_to_in_the_direction_of_then(direction, targets_deg):
    head, motion = head_and_motion()
    motion.return_to(Place(angle_deg=30.0, direction=direction), going_on)
    assert head.targets_deg == targets_deg
    assert motion.direction == (direction or 1)


def test_whoever_watches_a_move_is_told_where_it_goes(stand: FakeStand):
    seen = []
    motion = Motion(stand.head, stand.clock, 0.01, look=lambda status: seen.append(status.target_deg), title="head")
    motion.travel(90.0, lambda: False)
    assert set(seen) == {None, 90.0}
    assert seen[-1] == 90.0


def test_a_head_that_finds_its_reference_was_sent_nowhere(stand: FakeStand):
    seen = []
    motion = Motion(stand.head, stand.clock, 0.01, look=lambda status: seen.append(status.target_deg), title="head")
    motion.travel(90.0, lambda: False)
    seen.clear()
    motion.home(lambda: False)
    assert seen[-1] is None
