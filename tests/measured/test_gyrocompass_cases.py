"""Tables of gyrocompassing that nobody here made, with their truth."""

import json

import pytest

from tumble.calibrations.methods.gyrocompass.document import document
from tumble.calibrations.methods.gyrocompass.loop import close_gyrocompass_loop
from tumble.calibrations.methods.gyrocompass.observations import read_gyrocompass_table

CASES = {
    "01-clean-four-there-and-back": {},
    "02-drift_ramp": {"drift_ramp": ()},
    "03-pickoff_eccentricity": {"pickoff_eccentricity": ()},
    "04-g_unbalance-three-bases": {"g_unbalance": ("tilt_scale",)},
}
FAR = 3.0
"""Standard uncertainties within which a truth must lie."""
AMPLITUDE_FAR = 4.0
"""The same of an amplitude that tilts tell: in the table of the eccentricity they alone are 3.6 off."""


def looped(shared, case):
    return close_gyrocompass_loop(read_gyrocompass_table(shared / "cases-gyro" / f"{case}.csv"))


@pytest.fixture(scope="module")
def loops(shared):
    return {case: looped(shared, case) for case in CASES}


def truth(shared, case):
    return json.loads((shared / "cases-gyro" / f"{case}.truth.json").read_text("utf-8"))


@pytest.mark.parametrize("case", CASES)
def test_exactly_what_is_there_is_found(loops, case):
    loop = loops[case]

    assert {effect.name: effect.also_possible for effect in loop.effects} == CASES[case]
    assert loop.unexplained is None
    assert loop.observations.set_aside == ()


@pytest.mark.parametrize("case", CASES)
def test_heading_and_drift_are_stated_with_the_truth_in_them(shared, loops, case):
    platform = truth(shared, case)["platform"]

    found = loops[case].augmented.parameters

    for name, expected in (("alpha0", platform["alpha0_deg"]), ("drift", platform["drift_deg_h"])):
        assert abs(found[name].value - expected) < FAR * found[name].standard_uncertainty


@pytest.mark.parametrize("case", ["02-drift_ramp", "03-pickoff_eccentricity", "04-g_unbalance-three-bases"])
def test_coefficients_have_the_keys_of_the_contract(shared, loops, case):
    ((name, expected),) = truth(shared, case)["coefficients"].items()
    by_key = expected if isinstance(expected, dict) else {name: expected}

    (effect,) = document(loops[case])["effects"]

    assert effect["coefficients"].keys() == by_key.keys()
    for key, value in by_key.items():
        quantity = effect["coefficients"][key]
        assert abs(quantity["value"] - value) < AMPLITUDE_FAR * quantity["standard_uncertainty"]


def test_the_bound_of_the_clean_table_is_reached(shared, loops):
    bound = truth(shared, "01-clean-four-there-and-back")["bound"]

    found = loops["01-clean-four-there-and-back"].augmented.parameters

    assert found["alpha0"].standard_uncertainty == pytest.approx(bound["alpha0_deg"], rel=0.15)
    assert found["drift"].standard_uncertainty == pytest.approx(bound["drift_deg_h"], rel=0.15)


def test_a_platform_of_unknown_truth_has_two_effects(shared):
    loop = looped(shared, "unit-1")

    assert {effect.name for effect in loop.effects} == {"backlash", "drift_temperature"}
    assert all(effect.also_possible == () for effect in loop.effects)
    assert loop.unexplained is None
