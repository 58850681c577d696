"""A temperature in another unit is asked about; parameters would refer to a temperature hundreds of kelvin away."""

from dataclasses import replace

import numpy as np
import pytest
from loop_examples import PARTS
from tables import table

from tumble.calibrations.methods.dividing_head.questions import questioned


def at(first, last):
    """The declared model, with a temperature column between two values."""
    rows = table(*PARTS, realisations=3)
    return replace(rows, temperature_degc=np.linspace(first, last, len(rows)), source="t.csv")


@pytest.mark.parametrize(
    ("first", "last", "question"),
    [
        (293.15, 299.15, "t.csv: temperature_degC runs from 293.1 to 299.1; are these kelvin? Write °C"),
        (218.0, 333.0, "t.csv: temperature_degC runs from 218 to 333; are these kelvin? Write °C"),
        (29315.0, 29915.0, "t.csv: temperature_degC runs from 2.932e+04 to 2.992e+04; what unit is that? Write °C"),
    ],
)
def test_temperatures_that_are_none_in_celsius_are_asked_about_before_anything_is_traced(first, last, question):
    asked = questioned(at(first, last))

    assert (asked.questions, asked.answerable) == ((question,), False)


def test_a_room_in_fahrenheit_is_asked_about():
    asked = questioned(at(70.0, 76.0))

    assert asked.questions == (
        "t.csv: temperature_degC runs from 70 to 76, far from the 23 °C to which parameters refer; are these °F (from "
        "21.11 to 24.44 °C)? Write °C, or give reference_temperature_degC in the stand file",
    )


@pytest.mark.parametrize(
    ("first", "last", "reference_degc"), [(70.0, 76.0, 72.0), (20.0, 26.0, 23.0), (-40.0, 85.0, 23.0)]
)
def test_temperatures_of_a_chamber_or_a_room_are_taken_as_they_are(first, last, reference_degc):
    assert questioned(at(first, last), reference_degc).questions == ()
