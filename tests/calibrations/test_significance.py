"""Significance, identifiability and correlation of the parameters, in sentences."""

from dataclasses import replace

import numpy as np
import pytest
from report_examples import FLIPS, calibrate, dwells, face_up, flips_only, reversed_

from tumble.calibrations.core.sentences import series, significant_digits
from tumble.calibrations.methods.dividing_head.flips import FlipClosure, FlipMean
from tumble.calibrations.methods.dividing_head.significance import Kind, closure_sentence, statements


def texts(calibration, kind):
    return [statement.text for statement in statements(calibration) if statement.kind is kind]


def test_a_face_up_sweep_leaves_alpha0_resting_on_kxy():
    (text,) = texts(face_up(), Kind.DEPENDENCE)
    assert text.startswith("kx, ky, kz and alpha0 rest on kxy: identifiable through the curvature kxy alone")
    assert text.endswith("One sweep in any of face-down, edge-back or end would settle it.")


def test_with_a_face_down_sweep_nothing_rests_on_kxy():
    assert texts(reversed_(), Kind.DEPENDENCE) == []


def test_alpha0_and_ky_hang_together_only_without_a_reversal():
    assert [s.about for s in statements(face_up()) if s.kind is Kind.CORRELATION and "ky" in s.about] == [
        ("ky", "kz", "alpha0")
    ]
    assert not [s for s in statements(reversed_()) if s.kind is Kind.CORRELATION and "ky" in s.about]


def test_two_strongly_correlated_parameters_are_named_with_their_coefficient():
    matrix = np.eye(6)
    matrix[0, 1] = matrix[1, 0] = -0.95
    (text,) = texts(replace(reversed_(), correlation=matrix), Kind.CORRELATION)
    assert text.startswith("u0 and kx are strongly correlated (r = -0.950)")


def test_a_chain_of_strong_correlations_is_one_group():
    matrix = np.eye(6)
    matrix[0, 1] = matrix[1, 0] = matrix[1, 4] = matrix[4, 1] = 0.92
    (statement,) = [s for s in statements(replace(reversed_(), correlation=matrix)) if s.kind is Kind.CORRELATION]
    assert statement.about == ("u0", "kx", "kxy")


def test_the_scale_factor_differs_from_zero_and_has_digits():
    text = next(t for t in texts(reversed_(), Kind.SIGNIFICANCE) if t.startswith("kx"))
    assert "differs from zero" in text
    assert "supports 5 significant digits" in text


def test_an_interval_that_holds_zero_is_said_to_hold_it():
    parameters = dict(reversed_().parameters)
    parameters["kz"] = replace(parameters["kz"], value=0.003, interval_95=(-0.013, 0.019))
    found = texts(replace(reversed_(), parameters=parameters), Kind.SIGNIFICANCE)
    assert "kz does not differ significantly from zero: its 95% interval, -13 to 19 mV/g, includes it." in found


@pytest.mark.parametrize(
    ("value", "interval", "ending"),
    [
        (0.02, (0.004, 0.036), "is 80% of the value and supports its sign only."),
        (0.02, (0.019, 0.021), "is 5.0% of the value and supports 2 significant digits."),
        (1.0, (0.99998, 1.00002), "is 20 ppm of the value and supports 5 significant digits."),
        (1.0, (1.0, 1.0), "No uncertainty is stated, so that its digits cannot be judged."),
    ],
)
def test_the_uncertainty_says_how_many_digits_it_supports(value, interval, ending):
    parameters = dict(reversed_().parameters)
    parameters["ky"] = replace(parameters["ky"], value=value, interval_95=interval)
    found = texts(replace(reversed_(), parameters=parameters), Kind.SIGNIFICANCE)
    assert next(text for text in found if text.startswith("ky")).endswith(ending)


def test_a_parameter_without_a_value_is_explained_with_its_remedy():
    kxy, alpha0 = texts(flips_only(), Kind.NOT_IDENTIFIABLE)
    assert kxy == "kxy is not identifiable: its 95% interval is unbounded: no row has gravity along Ox and Oy at once."
    assert alpha0.startswith("alpha0 is not identifiable: its 95% interval reaches 45 deg")
    assert alpha0.endswith("would settle it.")


def test_what_lacks_for_one_reason_is_said_once():
    (text,) = texts(calibrate(dwells([("face-up", [0.0, 90.0])], realisations=1)), Kind.NOT_IDENTIFIABLE)
    assert text.startswith(
        "u0, kx, ky, kz, kxy and alpha0 are not identifiable: there are no more rows than parameters"
    )


def test_a_single_remedy_is_named_alone():
    parameters = dict(flips_only().parameters)
    parameters["alpha0"] = replace(parameters["alpha0"], settled_by=("end",))
    found = texts(replace(flips_only(), parameters=parameters), Kind.NOT_IDENTIFIABLE)
    assert found[1].endswith("One sweep in end would settle it.")


def test_without_alpha0_the_flips_give_ky_for_alpha0_zero():
    kx, ky, kz = texts(flips_only(), Kind.CONDITION)
    assert kx.startswith("kx stands for alpha0 = 0 deg")
    assert ky.startswith("ky stands for alpha0 = 0 deg; 1 deg of alpha0 would change it by 0.017 V/g.")
    assert kz.startswith("kz stands for")


def test_a_statement_is_plain_data():
    assert statements(face_up())[0].as_json().keys() == {"about", "kind", "text"}
    assert statements(face_up())[0].as_json()["about"] == ["u0"]


def test_flips_of_a_linear_unit_agree():
    sentence = closure_sentence(face_up().closure)
    assert sentence.startswith("The x, y and z flips agree on u0: the largest difference, ")


def test_flips_of_a_unit_with_an_undeclared_square_do_not_agree():
    closure = calibrate(dwells(FLIPS, k_xx=0.01)).closure
    assert closure_sentence(closure).startswith("The x, y and z flips do not agree on u0")
    assert closure_sentence(closure).endswith("(p < 0.0001 for all of them together).")


def mean(u0_v, u_v=1e-5):
    return FlipMean(u0_v=u0_v, standard_uncertainty_v=u_v, expected_v=u0_v)


def test_the_largest_difference_is_in_standard_uncertainties():
    closure = FlipClosure(axes={"x": mean(2.5), "y": mean(2.4999)}, p_value=0.3, worst=("x", "y", 1e-4, 7.07))
    assert closure_sentence(closure) == (
        "The x and y flips agree on u0: the largest difference, x - y, is 100 µV, or 7.1 standard uncertainties of it "
        "(p = 0.30 for all of them together)."
    )


def test_one_flip_alone_cannot_be_compared():
    closure = FlipClosure(axes={"x": mean(2.5)}, p_value=None, worst=None)
    assert closure_sentence(closure) == "Only the x flip is complete: there is nothing to compare its u0 with."


def test_flips_without_repeats_cannot_be_judged():
    closure = FlipClosure(axes={"x": mean(2.5, 0.0), "y": mean(2.4, 0.0)}, p_value=None, worst=None)
    assert "cannot be judged" in closure_sentence(closure)


@pytest.mark.parametrize(
    ("value", "expanded", "digits"),
    [(1.01643, 0.00036, 4), (0.0213, 0.016, 0), (933e-6, 32e-6, 2), (0.0, 1.0, 0), (1.0, 0.0, 0), (0.1, 5.0, 0)],
)
def test_digits_end_where_the_uncertainty_begins(value, expanded, digits):
    assert significant_digits(value, expanded) == digits


def test_names_are_joined_as_in_a_sentence():
    assert series(["x"]) == "x"
    assert series(["x", "y", "z"], "or") == "x, y or z"
