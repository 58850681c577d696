"""The closed loop in words."""

from dataclasses import replace

import pytest
from loop_examples import clean, found, misread, with_k_xx

from tumble.calibrations.methods.dividing_head.loop.misreading import Misreading
from tumble.calibrations.methods.dividing_head.loop.sentences import (
    comparisons,
    dependence,
    findings,
    findings_of,
    found_sentences,
    headline,
    misread_text,
    not_identifiable,
)
from tumble.calibrations.report.language import say, written_in
from tumble.calibrations.tracing.findings import Unexplained
from tumble.messages import Language


def finding(*arguments, **named):
    """The only line of a loop that found this effect."""
    (line,) = findings((found(*arguments, **named),))
    return line


def line_of(loop, name):
    (line,) = [line for line in comparisons(loop) if line.name == name]
    return line


def with_parameters(calibration, name, **changes):
    parameters = calibration.parameters
    return replace(calibration, parameters={**parameters, name: replace(parameters[name], **changes)})


def with_p(loop, p_value):
    return replace(loop, augmented=replace(loop.augmented, lack_of_fit_p=p_value))


def test_nothing_found_is_said_to_be_nothing():
    assert headline(clean()).startswith("Nothing is left that the scatter of the data does not explain")
    assert found_sentences(clean()) == []
    assert (findings(clean().effects), comparisons(clean())) == ([], [])


def test_nothing_found_where_the_poses_disagree_is_no_good_news():
    text = headline(with_p(clean(), 1e-6))
    assert text.startswith("Neither an effect of the catalogue nor any other structure was found, yet the poses")
    assert "p < 0.0001" in text


def test_an_effect_is_named_and_the_poses_judged():
    text = headline(with_p(with_k_xx(), 0.5))
    assert text == (
        "What the declared model leaves was traced to k_xx. With that taken into account the poses agree with the "
        "model (lack of fit: p = 0.50)."
    )


def test_poses_that_still_disagree_are_said_to():
    assert "the poses still disagree with the model (lack of fit: p < 0.0001)" in headline(with_p(with_k_xx(), 1e-9))


def test_without_a_test_of_fit_there_is_no_verdict():
    assert headline(with_p(with_k_xx(), None)) == "What the declared model leaves was traced to k_xx."


def test_structure_without_a_name_is_located():
    unexplained = Unexplained(depends_on="angle", description="a bump of 18 arcsec near 141 deg on the head")
    (sentence,) = found_sentences(replace(clean(), unexplained=unexplained))
    assert sentence == (
        "No effect of the catalogue explains what depends on angle: a bump of 18 arcsec near 141 deg on the head."
    )


def test_a_misread_row_is_named_with_its_error_and_changes_no_model():
    assert found_sentences(misread()) == ["Read or set wrong by a round amount: row 21 by 10°."]
    (line,) = findings_of(misread())
    assert (line.name, line.coefficients, line.belongs_to) == ("misreading", "row 21 by 10°", "stand")
    assert comparisons(misread()) == []


def test_many_misread_rows_are_counted():
    rows = [Misreading(row=row, error_deg=0.5) for row in range(1, 10)]
    assert misread_text(rows).endswith("row 6 by 0.5° and 3 more")


def test_one_coefficient_stands_alone():
    assert finding("k_xx", k_xx=(4.1e-4, 2e-5, "V/g^2")).coefficients == "410(20) µV/g²"


@pytest.mark.parametrize(
    ("unit", "text"), [("V/g^3", "410(20) µV/g³"), ("V/√h", "410(20) µV/h^½"), ("deg/h", "0.000410(20) °/h")]
)
def test_units_are_set_as_every_terminal_can_print_them(unit, text):
    assert finding("x", x=(4.1e-4, 2e-5, unit)).coefficients == text


def test_several_coefficients_have_their_names_without_the_unit():
    harmonic = {"amplitude_deg": (0.01, 3e-4, "deg"), "phase_deg": (30.1, 1.2, "deg"), "order": (7.0, None, "")}
    expected = "amplitude 0.01000(30)°, phase 30.1(12)°, order 7"
    assert finding("graduation", belongs_to="stand", **harmonic).coefficients == expected


def test_a_scanned_value_without_uncertainty_has_four_digits():
    step = {"step": (1e-4, 1e-5, "V"), "threshold_V": (2.51234567, None, "V")}
    assert finding("range_step", belongs_to="daq", **step).coefficients == "step 100(10) µV, threshold 2.512 V"


@pytest.mark.parametrize(
    ("key", "unit", "german"),
    [
        ("threshold_V", "V", "Schwelle 2,500 V"),
        ("period_V", "V", "Periode 2,500 V"),
        ("reach_g", "g", "Reichweite 2,500 g"),
        ("kept_g", "g", "Reichweite, bleibt beim neuen Aufspannen erhalten 2,500 g"),
        ("natural_hz", "Hz", "Resonanz 2,500 Hz"),
        ("row", "", "Zeile 2,500"),
    ],
)
def test_what_was_scanned_for_has_a_word_in_every_language(key, unit, german):
    coefficients = finding("x", **{"step": (1e-4, 1e-5, "V"), key: (2.5, None, unit)}).coefficients
    with written_in(Language.GERMAN):
        assert say(coefficients) == f"Stufe 100(10) µV, {german}"


def test_rivals_are_listed_with_or_and_the_owner_named():
    line = finding("k_xx", ("k_yy", "k_zz", "daq_nonlinearity"), "daq")
    assert (line.also_possible, line.belongs_to) == ("k_yy, k_zz or daq_nonlinearity", "DAQ")


def test_before_and_after_stand_side_by_side():
    loop = with_k_xx()
    names = ["residual, r.m.s.", "held-out error, r.m.s.", "lack of fit, p", "u0", "kx", "ky", "kz", "kxy", "alpha0"]
    assert [line.name for line in comparisons(loop)] == names
    residual = line_of(loop, "residual, r.m.s.")
    ratio = loop.augmented.residual_rms_v / loop.declared.residual_rms_v
    assert float(residual.change.removeprefix("× ")) == pytest.approx(ratio, rel=0.05)
    assert ratio < 0.5


def test_what_was_not_tested_or_not_held_out_is_said():
    loop = with_p(with_k_xx(), None)
    loop = replace(loop, augmented=replace(loop.augmented, held_out_rms_v=None))
    assert line_of(loop, "lack of fit, p").augmented == "not tested"
    held_out = line_of(loop, "held-out error, r.m.s.")
    assert (held_out.augmented, held_out.change) == ("none", "")


def moved(**changes):
    """The line of kz after it was changed from 2(1) mV/g."""
    loop = with_k_xx()
    before = {"value": 2e-3, "standard_uncertainty": 1e-3, "given": {}}
    declared = with_parameters(loop.declared, "kz", **before)
    augmented = with_parameters(loop.augmented, "kz", **{**before, **changes})
    return line_of(replace(loop, declared=declared, augmented=augmented), "kz")


def test_a_change_is_stated_in_the_uncertainties_before():
    line = moved(value=4.5e-3, standard_uncertainty=1e-4)
    assert (line.declared, line.augmented, line.change) == ("2.0(10) mV/g", "4.50(10) mV/g", "+2.5 mV/g (+2.5 u)")


def test_a_change_far_below_the_uncertainty_is_none():
    assert moved(value=2e-3 + 5e-6).change == "none"


def test_values_for_different_alpha0_are_not_subtracted():
    line = moved(value=4.5e-3, given={"alpha0": 0.0})
    assert (line.augmented, line.change) == ("4.5(10) mV/g, given alpha0 = 0°", "")


def test_what_is_not_identifiable_any_more_has_its_reason():
    loop = with_k_xx()
    withheld = with_parameters(loop.augmented, "kz", value=None, reason="it differs between k_xx and k_yy")
    loop = replace(loop, augmented=withheld)
    assert line_of(loop, "kz").augmented == "not identifiable"
    assert ("kz", "it differs between k_xx and k_yy") in not_identifiable(loop)


def test_what_rests_on_kxy_alone_is_said_with_what_would_settle_it():
    resting_on_kxy = {
        "rests_on": "kxy",
        "remark": "identifiable through the curvature kxy alone",
        "settled_by": ("edge", "end"),
    }
    augmented = with_parameters(with_parameters(clean().augmented, "ky", **resting_on_kxy), "alpha0", **resting_on_kxy)

    assert dependence(replace(clean(), augmented=augmented)) == (
        "ky and alpha0 rest on kxy alone: identifiable through the curvature kxy alone; a sweep in edge or end would "
        "settle it"
    )
    assert dependence(clean()) == ""
