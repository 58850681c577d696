import os
from contextlib import contextmanager
from dataclasses import replace

import pytest

from benchmarks.endurance.killing import Job
from benchmarks.endurance.kills import (
    DRIFT,
    Survived,
    at_boundaries,
    at_random,
    carried_out,
    greatest_difference,
    identical,
    resumed,
    safe,
    summary,
)

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL")

PROGRAMME = """
name = "twenty"
realisations = 2
dwell_s = 0.1

[[procedure]]
kind = "flip"
axes = ["x", "y"]

[[procedure]]
kind = "sweep"
step_deg = 60.0
points = 6
"""


@pytest.fixture(scope="module")
def programme(tmp_path_factory):
    path = tmp_path_factory.mktemp("programme") / "twenty.toml"
    path.write_text(PROGRAMME)
    return str(path)


@pytest.fixture(scope="module")
def whole(programme, tmp_path_factory):
    """A run that nobody killed: its recording, and what it gave."""
    folder = tmp_path_factory.mktemp("whole")
    return folder / "whole.mcap", carried_out(Job(programme=programme), folder)


def test_a_run_that_is_killed_at_a_random_moment_ends_with_the_same_bits(programme, whole):
    survived = at_random(Job(programme=programme), count=1, seed=1, expected=whole[1])
    assert len(survived) == 1
    assert safe(survived) and identical(survived), survived


def test_on_a_stand_that_drifts_and_lives_on_what_comes_after_a_kill_is_another(programme):
    (survived,) = at_boundaries(Job(programme=programme, simulated=DRIFT, outage_s=0.1), every=20)
    assert safe([survived]), survived
    assert survived.points_before == 1
    assert 0 < survived.changed <= 19


def test_a_run_that_cannot_go_on_has_lost_its_points(programme, whole, tmp_path):
    path, expected = whole
    recording = tmp_path / "run.mcap"
    recording.write_bytes(path.read_bytes()[:-2000])
    with unknown_stand(path):
        survived = resumed(recording, Job(programme=programme), expected)
    assert survived.lost == survived.points_before > 0
    assert not safe([survived])
    assert survived.failed in summary("broken", [survived])


@contextmanager
def unknown_stand(recording):
    """Have the stand file of a recording be away."""
    stand = recording.with_suffix(".toml")
    elsewhere = stand.rename(stand.with_suffix(".away"))
    yield
    elsewhere.rename(stand)


@pytest.mark.parametrize("fault", [Survived(lost=1), Survived(doubled=1), Survived(failed="no")])
def test_a_loss_is_not_safe(fault):
    assert not safe([Survived(), fault])


@pytest.mark.parametrize("fault", [Survived(changed=1), Survived(off=1e-12)])
def test_a_changed_bit_is_not_identical(fault):
    assert not identical([Survived(), fault])


def test_a_parameter_that_is_told_in_one_run_only_is_infinitely_far_off(whole):
    parameters = whole[1].parameters
    untold = parameters | {"kx": replace(parameters["kx"], value=None)}
    assert greatest_difference(parameters, parameters) == 0.0
    assert greatest_difference(untold, parameters) == float("inf")
