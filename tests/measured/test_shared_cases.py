"""Tables that nobody here made: blind-made ones with their truth, and measured ones."""

import json

import pytest

from tumble.app.analysing import fit
from tumble.app.measurements import read_measurement

NAMES = ("u0", "kx", "ky", "kz", "kxy", "alpha0")


def calibration(path):
    return fit(read_measurement(path), trials=0).calibration


def truth(shared, case):
    return json.loads((shared / "cases" / f"{case}.truth.json").read_text("utf-8"))


@pytest.mark.parametrize("case", ["15-clean-seed-programme", "16-clean-reversal"])
def test_a_clean_table_gives_its_truth_back(shared, case):
    unit = truth(shared, case)["unit"]
    expected = {name: unit["alpha0_deg" if name == "alpha0" else name] for name in NAMES}

    found = calibration(shared / "cases" / f"{case}.csv").parameters

    assert [
        name for name in NAMES if abs(found[name].value - expected[name]) > 3 * found[name].standard_uncertainty
    ] == []


def test_exactly_the_misread_rows_are_set_aside(shared):
    misread = {row for row, _ in truth(shared, "11-misreading")["misread_rows"]}

    found = calibration(shared / "cases" / "11-misreading.csv")

    assert {entry.row for entry in found.observations.set_aside} == misread


@pytest.mark.parametrize("name", ["alpha0", "ky"])
def test_sweeps_alone_rest_on_kxy_and_it_is_said_what_would_settle_it(shared, name):
    parameter = calibration(shared / "cases" / "19-absorbed-k_xx-sweeps-only.csv").parameters[name]

    assert parameter.rests_on == "kxy"
    assert parameter.settled_by == ("face-down", "edge", "edge-back", "end")


# Means of the 24 rows, and half the difference between the means at -90° and 90°, taken by hand from each file.
@pytest.mark.parametrize(
    ("axis", "u0_v", "kx_v"),
    [("x", 0.091205486, 0.999893098), ("y", 0.046646054, 1.000219950), ("z", -0.249300893, 1.022248683)],
)
def test_measured_flips_give_bias_and_scale_factor(shared, axis, u0_v, kx_v):
    found = calibration(shared / "data" / f"flip_mpu9250_{axis}.csv").parameters

    assert found["u0"].value == pytest.approx(u0_v, abs=1e-8)
    assert found["kx"].value == pytest.approx(kx_v, abs=1e-8)


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_measured_flips_tell_cross_axis_terms_for_a_given_alpha0_only(shared, axis):
    found = calibration(shared / "data" / f"flip_mpu9250_{axis}.csv").parameters

    assert (found["alpha0"].value, found["kxy"].value) == (None, None)
    assert found["ky"].given == found["kz"].given == {"alpha0": 0.0}


def test_the_flips_of_the_y_sensor_do_not_close(shared):
    closure = calibration(shared / "data" / "flip_mpu9250_y.csv").closure

    first, second, difference_v, sigmas = closure.worst
    assert (first, second) == ("y", "z")
    assert difference_v == pytest.approx(6.498e-3, abs=1e-5)
    assert sigmas > 10
