"""What the closed loop found in a result, whatever somebody put into its JSON."""

from dataclasses import replace

import pytest
from records_examples import calibration, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.findings import effects_of, is_unexplained, text_of
from tumble.calibrations.records.store import Store

NO_RESULT_OF_OURS = [
    {"loop": None},
    {"loop": [1]},
    {"effects": None},
    {"effects": "k_xx"},
    {"effects": 7},
    {"effects": ["k_xx", None, {}, {"name": None}]},
    {"parameters": {"kx": 1.0}},
    {"parameters": {"kx": {"effects": None}}},
    {"parameters": [1]},
]


@pytest.fixture
def record(tmp_path):
    return Store(tmp_path).add(entry(calibration()), provenance())


@pytest.mark.parametrize("result", NO_RESULT_OF_OURS)
def test_nothing_is_found_in_what_is_no_result_of_ours(record, result):
    altered = replace(record, result=result)
    assert effects_of(altered) == ()
    assert not is_unexplained(altered)
    assert text_of(result) == ""
