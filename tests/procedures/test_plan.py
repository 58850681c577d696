import pytest

from tumble.procedures.acquisition import Acquisition
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.plan import plan
from tumble.procedures.plan_checks import check_condition, check_limits
from tumble.procedures.programmes import load_programme, programme_from_text
from tumble.procedures.steps import Ask, Dwell

SMALL = """\
name = "small"
realisations = 2

[[procedure]]
kind = "flip"
axes = ["x", "y"]
pole = "extremum"

[[procedure]]
kind = "sweep"
mount = "edge"
start_deg = 100.0
step_deg = 20.0
points = 3
"""
ACQUISITION = Acquisition(samples=100, rate_hz=50.0, settle_s=0.5, settle_samples=10)


def planned(text=SMALL, **settings):
    return plan(programme_from_text(text, "small.toml"), ACQUISITION, speeds_deg_s={"head": 10.0}, **settings)


def shipped(name):
    programme = load_programme(name)
    acquisition = programme.acquisition(samples=100, rate_hz=100.0)
    return plan(programme, acquisition, speeds_deg_s={"head": 20.0}, request_s=0.0)


@pytest.mark.parametrize(
    ("name", "dwells", "mount_changes"), [("seed", 430, 11), ("reversal", 2880, 21), ("quick", 60, 6)]
)
def test_the_programmes_that_come_along_have_their_size(name, dwells, mount_changes):
    whole = shipped(name)
    assert (whole.dwells, whole.requests) == (dwells, mount_changes)


def test_the_quick_programme_takes_a_minute_or_two_and_the_mountings():
    assert 60 < shipped("quick").duration_s < 300


def test_the_published_programme_has_five_flips_and_five_sweeps_over_400_degrees():
    dwells = [step.step for step in shipped("seed").steps if isinstance(step.step, Dwell)]
    assert [dwell.procedure for dwell in dwells] == (["flip"] * 6 + ["sweep"] * 80) * 5
    assert [dwell.targets_deg["head"] for dwell in dwells[6:86]] == [5.0 * number for number in range(80)]


def test_a_step_takes_its_move_its_settling_and_its_samples():
    whole = planned(request_s=90.0, start_deg=-95.0)
    assert [step.duration_s for step in whole.steps[:3]] == pytest.approx([90.0, 0.5 + 0.5 + 0.4 + 2.0, 1.0 + 2.9])
    assert whole.duration_s == pytest.approx(sum(step.duration_s for step in whole.steps))


def test_a_plan_knows_its_dwells_its_mountings_and_its_range():
    whole = planned()
    assert (whole.dwells, whole.requests, whole.angle_range_deg) == (2 * (14 + 2 + 3), 4, (-100.0, 180.0))


def test_what_is_left_begins_after_the_last_point():
    whole = planned()
    assert whole.steps_after(0) == whole.steps
    assert isinstance(whole.steps_after(16)[0].step, Ask)
    assert len(whole.steps_after(17)) == len(whole.steps) - 19
    assert whole.steps_after(38) == ()


def test_a_plan_within_the_limits_passes():
    check_limits(planned(), "head", (-100.0, 180.0))


@pytest.mark.parametrize(
    ("limits_deg", "complaint"),
    [
        (
            (-95.0, 360.0),
            "small.toml, line 4: the seek goes to -100 deg, outside the head's limits of -95 to 360 deg; change the "
            "angles, or the limits of the stand",
        ),
        (
            (-180.0, 179.0),
            "small.toml, line 4: the flip goes to 180 deg, outside the head's limits of -180 to 179 deg; change the "
            "angles, or the limits of the stand",
        ),
    ],
)
def test_a_plan_beyond_the_limits_is_refused(limits_deg, complaint):
    with pytest.raises(ProgrammeError) as raised:
        check_limits(planned(), "head", limits_deg)
    assert str(raised.value) == complaint


def test_the_procedure_that_goes_too_far_is_named_by_its_line():
    with pytest.raises(ProgrammeError, match=r"^small\.toml, line 9: the sweep goes to 200 deg"):
        check_limits(planned(SMALL.replace("step_deg = 20.0", "step_deg = 50.0")), "head", (-100.0, 180.0))


def test_a_programme_without_a_file_of_its_own_is_still_named():
    inline = 'name = "a"\nprocedure = [\n  { kind = "flip", axes = ["x"] },\n]\n'
    with pytest.raises(ProgrammeError, match=r"^small\.toml, line 2: the flip goes to -90 deg"):
        check_limits(planned(inline), "head", (0.0, 180.0))


def test_a_mount_that_the_seat_does_not_allow_is_refused():
    check_condition(planned(), "mount", None)
    with pytest.raises(
        ProgrammeError, match=r"line 9: the sweep needs the mount edge, and the seat allows face-up only"
    ):
        check_condition(planned(), "mount", ["face-up"])
