"""Two records that are compared say what is not the same in both."""

from dataclasses import replace

import pytest
from records_examples import calibration, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.store import Store
from tumble.calibrations.records.unlike import unlike


@pytest.fixture
def record(tmp_path):
    return Store(tmp_path).add(entry(calibration()), provenance(lot="L-1"))


def of(record, **changed):
    """The same record with another origin."""
    return replace(record, provenance=replace(record.provenance, **changed))


def test_of_records_that_are_alike_nothing_is_said(record):
    assert unlike(record, of(record, operator="somebody else", measured_at="2026-11-25T08:00:00+00:00")) == ()


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"serial_number": "OTHER"}, "They are of two units: SN 17, OTHER."),
        ({"lot": "L-2"}, "They are of two lots: L-1, L-2."),
        ({"lot": ""}, "Only one of them names a lot: L-1."),
        ({"programme_name": "quick"}, "They are of two programmes: seed, quick."),
        ({"programme_sha256": "00"}, "The programme seed is not the same file in both."),
        ({"stand_name": "north"}, "They are of two stands: bench-1, north."),
        ({"stand": {"name": "bench-1", "hall": 2}}, "The stand bench-1 is not described alike in both."),
        ({"stand_name": ""}, "They are of two stands: bench-1, —."),
    ],
)
def test_what_is_not_alike_is_said(record, changed, said):
    assert unlike(record, of(record, **changed)) == (said,)


def test_a_simulated_stand_is_told_from_a_real_one(record):
    simulated = of(record, stand={"head": {"driver": "simulated"}})
    assert "Only one of them was measured at a simulated stand." in unlike(record, simulated)


def test_another_version_of_the_method_is_told(record):
    assert unlike(record, replace(record, method_version=99))[-1].endswith(", 99.")
