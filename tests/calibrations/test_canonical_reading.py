"""JSON of a store is read as Python's `json` reads it."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.calibrations.records.canonical import canonical_text, read_json

CONTENT = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda each: st.lists(each) | st.dictionaries(st.text(), each),
)


@given(CONTENT)
def test_what_was_written_is_read(content):
    text = canonical_text(content)
    assert read_json(text) == json.loads(text)


@pytest.mark.parametrize("number", [2**63 - 1, 2**64, -(2**63) - 1, 10**30])
def test_a_long_integer_keeps_all_its_digits(number):
    read = read_json(f'{{"seed":{number}}}')["seed"]
    assert (type(read), read) == (int, number)


def test_what_is_no_json_of_the_standard_is_read_as_before():
    assert math.isnan(read_json("NaN"))
    assert read_json('"\\ud800"') == "\ud800"


def test_half_a_document_is_an_error():
    with pytest.raises(json.JSONDecodeError):
        read_json('{"a":')
