"""A run through the wire: `tumble emulate` in a process of its own, `tumble run` against it."""

import os
from dataclasses import replace

import pytest

from benchmarks.endurance.pairs import PAIRS, agrees, row, served, simulated, whole

PROGRAMME = """
name = "short"
realisations = 2
dwell_s = 0.5

[[procedure]]
kind = "flip"
axes = ["x", "y"]

[[procedure]]
kind = "sweep"
mount = "face-down"
step_deg = 30.0
points = 5
"""
TRUE_KX = 1.0


@pytest.fixture(scope="module")
def programme(tmp_path_factory):
    path = tmp_path_factory.mktemp("programme") / "short.toml"
    path.write_text(PROGRAMME)
    return str(path)


@pytest.fixture(scope="module")
def reference(programme):
    return simulated(programme)


@pytest.mark.skipif(os.name == "nt", reason="SIGINT cannot be sent to one process on Windows")
@pytest.mark.parametrize("pair", ["zaber, can", "cia402, scpi", "manual, scpi"])
def test_a_run_through_the_wire_gives_what_the_simulated_stand_gives(pair, programme, reference, tmp_path):
    with served(PAIRS[pair], tmp_path, speed=30.0) as stand:
        one = whole(pair, stand, programme)

    assert one.points == 2 * (4 + 5)
    assert agrees(one, reference)
    kx = one.calibration.parameters["kx"]
    assert abs(kx.value - TRUE_KX) < 4 * kx.standard_uncertainty


def test_a_unit_with_another_scale_factor_does_not_agree(reference):
    kx = reference.calibration.parameters["kx"]
    parameters = {**reference.calibration.parameters, "kx": replace(kx, value=1.01 * kx.value)}
    other = replace(reference, calibration=replace(reference.calibration, parameters=parameters))

    assert agrees(reference, reference)
    assert not agrees(other, reference)


def test_a_run_with_a_point_too_few_does_not_agree(reference):
    assert not agrees(replace(reference, points=reference.points - 1), reference)


def test_a_row_has_the_difference_from_the_simulated_stand_and_from_the_truth(reference):
    assert row(reference, reference).count("| +0.000, ") == len(reference.values)
