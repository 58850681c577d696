"""The closed loop as JSON."""

import json
from dataclasses import replace

import numpy as np
from loop_examples import K_XX, clean, found, misread, with_k_xx

from tumble.calibrations.methods.dividing_head.document import document, result_document
from tumble.calibrations.tracing.findings import Unexplained

MODEL_KEYS = {"parameters", "residual_rms_V", "held_out_rms_V", "lack_of_fit_p"}


def test_the_document_has_every_key_of_its_format():
    found = document(with_k_xx())
    assert found["schema"] == "tumble.loop/1"
    assert found["rows"] == {"read": 162, "used": 162, "set_aside": []}
    assert set(found["noise"]) == {"pure_error_V", "degrees_of_freedom"}
    assert set(found["declared"]) == set(found["augmented"]) == MODEL_KEYS
    assert {"effects", "unexplained", "next_experiment"} <= set(found)
    assert json.loads(json.dumps(found, allow_nan=False)) == found


def test_an_effect_has_name_rivals_owner_and_coefficients():
    (effect,) = document(with_k_xx())["effects"]
    assert (effect["name"], effect["belongs_to"]) == ("k_xx", "unit")
    assert isinstance(effect["also_possible"], list)
    coefficient = effect["coefficients"]["k_xx"]
    assert coefficient["unit"] == "V/g^2"
    assert abs(coefficient["value"] - K_XX) < 3 * coefficient["standard_uncertainty"]
    assert effect["p_value"] < 1e-6


def test_on_clean_data_there_is_nothing():
    found = document(clean())
    assert (found["effects"], found["unexplained"]) == ([], None)


def test_misreadings_are_rows_and_errors():
    found = document(misread())
    (effect,) = found["effects"]
    assert (effect["name"], effect["belongs_to"]) == ("misreading", "stand")
    assert effect["coefficients"] == {"rows": [21], "error_deg": [10.0]}
    assert [entry["row"] for entry in found["rows"]["set_aside"]] == [21]


def test_structure_without_a_name_has_its_variable_and_a_sentence():
    unexplained = Unexplained(depends_on="time", description="a step at 900 s")
    assert document(replace(clean(), unexplained=unexplained))["unexplained"] == {
        "depends_on": "time",
        "description": "a step at 900 s",
    }


def test_an_uncertainty_that_is_no_number_is_null():
    loop = replace(clean(), effects=(found("k_xx", k_xx=(1.0, np.nan, "V/g^2")),))
    assert document(loop)["effects"][0]["coefficients"]["k_xx"]["standard_uncertainty"] is None


def test_a_parameter_that_is_withheld_is_null_with_its_reason_and_a_conditional_one_says_for_what():
    parameters = dict(clean().augmented.parameters)
    parameters["kx"] = replace(parameters["kx"], value=None, standard_uncertainty=None, reason="because")
    parameters["ky"] = replace(parameters["ky"], given={"alpha0": 0.0})
    stated = document(replace(clean(), augmented=replace(clean().augmented, parameters=parameters)))["augmented"]
    assert (stated["parameters"]["kx"]["value"], stated["parameters"]["kx"]["reason"]) == (None, "because")
    assert stated["parameters"]["ky"]["given"] == {"alpha0": 0.0}


def test_a_calibration_has_its_loop_under_a_key_of_its_own():
    calibration = clean().declared
    assert result_document(calibration, None) == calibration.as_json()
    assert result_document(calibration, clean()) == calibration.as_json() | {
        "model": "declared",
        "loop": document(clean()),
    }
