"""What the loop found, as a list of records is asked for it and as one record says it."""

import json
from dataclasses import replace

import pytest
from app_jobs import tumble
from records_examples import calibration, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.store import Store

K_XX, STEP = ({"name": name, "coefficients": {}} for name in ("k_xx", "temperature_step"))
UNNAMED = {"courses": []}


@pytest.fixture
def store(tmp_path):
    """A unit for each way in which something is found, and one in which nothing is."""
    fitted, kept = entry(calibration()), Store(tmp_path)
    loops = {
        "nothing": {},
        "both": {"effects": [K_XX], "unexplained": UNNAMED},
        "unnamed": {"unexplained": UNNAMED},
        "twice": {"parameters": {"kx": {"effects": [STEP]}, "u0": {"effects": [STEP, K_XX]}}},
    }
    for unit, loop in loops.items():
        kept.add(replace(fitted, result=loop), provenance(serial_number=unit))
    return kept


@pytest.mark.parametrize(
    ("unit", "said"),
    [
        ("nothing", []),
        ("both", ["with k_xx, structure without a name"]),
        ("unnamed", ["with structure without a name"]),
        ("twice", ["with k_xx, temperature_step"]),
    ],
)
def test_a_record_says_once_all_that_was_found(store, unit, said):
    shown = tumble("records", "show", store.latest(unit).id, "--store", store.folder).out
    assert [line for line in shown.splitlines() if line.startswith("with ")] == said


@pytest.mark.parametrize(
    ("effect", "units"),
    [
        ("k_xx", {"both", "twice"}),
        ("structure without a name", {"both", "unnamed"}),
        ("temperature_step", {"twice"}),
        ("k_x", set()),
        ("", {"nothing"}),
    ],
)
def test_records_are_listed_by_effect(store, effect, units):
    found = json.loads(tumble("records", "list", "--effect", effect, "--store", store.folder, "--json", "-").out)
    assert {each["provenance"]["serial_number"] for each in found["records"]} == units


def test_a_list_says_the_lot_below_the_unit(store):
    store.add(entry(calibration()), provenance(serial_number="SN 7", lot="L [26]/3"))
    lines = tumble("records", "list", "--lot", "L [26]/3", "--store", store.folder).out.splitlines()
    assert any("dividing_head" in line and "L [26]/3" in line for line in lines)
