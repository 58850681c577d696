"""Structure without a name, predicted in realisations that a table does not hold."""

import numpy as np
import pytest

from benchmarks.blind.clock import drawn_run
from benchmarks.blind.courses import stated_courses
from benchmarks.blind.world import Unit, respond_v

UNIT = Unit(u0=2.5, kx=1.0, ky=0.0098, kz=0.002, kxy=0.001, alpha0_deg=0.1121)


def course(channel, variable, at, value, detail=""):
    return {"courses": [{"channel": channel, "variable": variable, "detail": detail, "at": at, "value": value}]}


def added_v(unexplained):
    run = drawn_run("mounts", 2, 1, np.random.default_rng(3))
    return respond_v(run, UNIT, stated_courses(unexplained)) - respond_v(run, UNIT), run


def test_an_offset_is_added_between_its_places_and_round_the_turn():
    added, run = added_v(course("offset", "angle", [0.0, 90.0, 180.0, 270.0], [0.0, 9e-4, 0.0, 0.0]))

    assert added[run.angle_deg % 360.0 == 45.0] == pytest.approx(4.5e-4)
    assert added[run.angle_deg % 360.0 == 355.0] == pytest.approx(0.0)


def test_a_scale_is_taken_times_ax():
    added, run = added_v(course("scale", "temperature", [0.0, 40.0], [1e-3, 1e-3]))

    assert added[(run.mount == "face-up") & (run.angle_deg == 90.0)] == pytest.approx(-1e-3, rel=1e-3)


def test_an_error_of_the_angle_turns_the_head():
    added, run = added_v(course("angle", "angle", [0.0, 180.0], [0.01, 0.01]))

    assert added[(run.mount == "face-up") & (run.angle_deg == 180.0)] == pytest.approx(np.deg2rad(0.01), rel=0.02)


def test_a_reversal_turns_the_head_after_moves_in_the_negative_direction_alone():
    said = course("angle", "angle", [0.0, 180.0], [0.01, 0.01])
    said["courses"][0]["channel_detail"] = "reversal"
    added, run = added_v(said)

    assert not added[run.direction > 0].any()
    assert added[(run.direction < 0) & (run.mount == "face-up") & (run.angle_deg == 180.0)] == pytest.approx(
        np.deg2rad(0.01), rel=0.02
    )


def test_a_course_in_time_is_expected_at_its_mean():
    added, _ = added_v(course("offset", "time", [0.0, 0.5, 1.0], [0.0, 1e-3, 2e-3]))

    assert added == pytest.approx(1e-3)


def test_without_a_course_nothing_is_predicted():
    assert stated_courses({"depends_on": "angle"}) is None


def test_a_variable_of_the_table_alone_gives_no_prediction():
    assert stated_courses(course("offset", "temperature", [0.0, 1.0], [1e-3, 1e-3], detail="rate")) is None
