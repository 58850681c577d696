"""Digits, prefixes and units."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.calibrations.core import quantities as q


@pytest.mark.parametrize(
    ("value", "uncertainty", "unit", "text"),
    [
        (1.0164315, 0.00035331, "V/g", "(1.01643 ± 0.00035) V/g"),
        (2.53880311, 5.18e-5, "V", "(2.538803 ± 0.000052) V"),
        (0.02132, 0.0162, "V/g", "(21 ± 16) mV/g"),
        (0.00338, 0.0162, "V/g", "(3 ± 16) mV/g"),
        (9.3339e-4, 3.14e-5, "V/g^2", "(933 ± 31) µV/g²"),
        (1.23e-5, 4e-8, "V/g", "(12.300 ± 0.040) µV/g"),
        (-0.339, 0.9137, "deg", "(-0.34 ± 0.91) °"),
        (9.7e-6, 1.66e-7, "V/(m/s^2)^2", "(9.70 ± 0.17) µV/(m/s²)²"),
        (0.012e-3, 0.346e-3, "V", "(0.01 ± 0.35) mV"),
        (1.0, 0.0996, "V", "(1.00 ± 0.10) V"),
        (-1e-9, 0.5, "deg", "(0.00 ± 0.50) °"),
        (1234.6, 12.0, "deg", "(1235 ± 12) °"),
        (1234.6, 120.0, "deg", "(1230 ± 120) °"),
        (0.5, None, "V", "500.000 mV"),
        (2.5, 0.0, "V", "2.50000 V"),
        (12.0, math.inf, "deg", "12.0000°"),
    ],
)
def test_the_value_ends_where_two_digits_of_the_uncertainty_end(value, uncertainty, unit, text):
    assert q.format_quantity(value, uncertainty, unit) == text


@pytest.mark.parametrize(
    ("value", "uncertainty", "unit", "text"),
    [
        (1.0164315, 0.00018, "V/g", "1.01643(18) V/g"),
        (0.0213, 0.0082, "V/g", "21.3(82) mV/g"),
        (10.17, 0.28, "deg", "10.17(28)°"),
        (0.1, 0.012, "V", "100(12) mV"),
        (2.5, None, "V", "2.50000 V"),
    ],
)
def test_the_concise_form_holds_the_uncertainty_in_units_of_the_last_place(value, uncertainty, unit, text):
    assert q.format_concise(value, uncertainty, unit) == text


@pytest.mark.parametrize(
    ("low", "high", "unit", "text"),
    [
        (0.00513, 0.03752, "V/g", "5 to 38 mV/g"),
        (0.000938, 0.001016, "V/g", "938 to 1016 µV/g"),
        (0.38, 0.4, "percent", "0.380 to 0.400 %"),
        (2.538751, 2.538855, "V", "2.538751 to 2.538855 V"),
        (-1.2516, 0.5758, "deg", "-1.25 to 0.58°"),
        (1.0, 1.0, "V", "1.000 to 1.000 V"),
    ],
)
def test_an_interval_has_two_digits_of_its_half_width(low, high, unit, text):
    assert q.format_interval(low, high, unit) == text


@pytest.mark.parametrize(
    ("minimum", "maximum", "text"),
    [
        (0.95, 1.05, "0.95 to 1.05 V/g"),
        (-0.02, 0.02, "-20 to 20 mV/g"),
        (None, 0.003, "up to 3 mV/g"),
        (0.003, None, "from 3 mV/g"),
        (0.0, 0.5, "0 to 500 mV/g"),
    ],
)
def test_limits_stand_as_somebody_wrote_them(minimum, maximum, text):
    assert q.format_limits(minimum, maximum, "V/g") == text


@pytest.mark.parametrize(
    ("value", "uncertainty", "minimum", "maximum", "text"),
    [
        (0.99994, 0.00015, 0.99, 1.01, "990 to 1010 mV/g"),
        (1.00013, 0.00015, 0.99, 1.01, "0.99 to 1.01 V/g"),
        (0.99994, None, 0.99, None, "from 990 mV/g"),
        (20e-6, 1e-6, -5.0, 5.0, "-5 to 5 V/g"),
        (2.5, 0.1, -20e-6, 20e-6, "-20 to 20 µV/g"),
    ],
)
def test_limits_are_in_the_unit_of_the_value_beside_them(value, uncertainty, minimum, maximum, text):
    assert q.format_limits_beside(value, uncertainty, minimum, maximum, "V/g") == text


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (1.0205e-4, 3, "102 µV"),
        (0.010174, 3, "10.2 mV"),
        (1.78e-7, 2, "180 nV"),
        (0.0, 3, "0 V"),
        (-0.0, 3, "0 V"),
        (2e-16, 2, "0.00020 pV"),
    ],
)
def test_a_bare_number_has_the_digits_that_are_asked_for(value, digits, text):
    assert q.format_number(value, "V", digits) == text


def test_a_number_of_no_everyday_size_keeps_its_exponent():
    assert q.format_number(3.2e12) == "3.2e+12"


@pytest.mark.parametrize(
    ("p_value", "text"), [(0.408, "0.41"), (0.0021, "0.0021"), (4.7e-13, "< 0.0001"), (1.0, "1.0")]
)
def test_a_small_probability_is_said_to_be_small(p_value, text):
    assert q.format_probability(p_value) == text


@pytest.mark.parametrize(
    ("freedom", "text"),
    [(2.0003, "2"), (617.99, "617"), (335992.0, "> 10000"), (math.inf, "∞"), (None, "")],
)
def test_degrees_of_freedom_are_truncated(freedom, text):
    assert q.format_freedom(freedom) == text


@pytest.mark.parametrize(
    ("coefficient", "text"),
    [
        (0.0385, "0.04"),
        (-0.9611, "-0.961"),
        (0.929, "0.929"),
        (-0.9999960, "-0.999996"),
        (1.0, "1"),
        (-1.0, "-1"),
        (-1e-9, "0.00"),
    ],
)
def test_a_correlation_shows_how_far_it_is_from_one(coefficient, text):
    assert q.format_correlation(coefficient) == text


@given(
    value=st.floats(-1e3, 1e3),
    uncertainty=st.floats(1e-9, 90.0),
    unit=st.sampled_from(["V", "V/g", "V/g^2", "deg"]),
)
def test_what_is_printed_is_the_value_within_half_a_unit_of_its_last_place(value, uncertainty, unit):
    text = q.rounded(value, uncertainty, unit)
    scale = {"m": 1e-3, "µ": 1e-6, "n": 1e-9, "p": 1e-12, "k": 1e3}.get(text.unit[0], 1.0) if unit != "deg" else 1.0
    step = float(text.uncertainty) / float(text.last_place) if "." in text.uncertainty else 1.0
    assert float(text.value) * scale == pytest.approx(value, abs=0.51 * step * scale)
    assert float(text.uncertainty) * scale == pytest.approx(uncertainty, rel=0.051)


@given(value=st.floats(-1e3, 1e3), uncertainty=st.floats(1e-9, 1e2))
def test_every_text_can_be_printed_on_a_western_terminal(value, uncertainty):
    texts = (q.format_quantity(value, uncertainty, "V/g^2"), q.format_concise(value, uncertainty, "deg"))
    assert "".join(texts).encode("cp1252")
