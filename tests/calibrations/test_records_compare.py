"""Two records side by side."""

from dataclasses import replace

import pytest
from records_examples import calibration, provenance, raw_source, sweep_only

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.compare import compare
from tumble.calibrations.records.store import Store


@pytest.fixture
def record(tmp_path):
    """Makes a record whose only parameter is kx, as given."""
    store = Store(tmp_path)

    def make(*raw, freedom=float("inf"), **fields):
        told = {"value": 1.0, "standard_uncertainty": 3e-4, "type_a": 3e-4, "interval_95": (0.9, 1.1), **fields}
        # What a value is given by stands in the same record.
        conditions = {"alpha0": calibration().parameters["alpha0"]} if "given" in fields else {}
        kx = Parameter(**({"name": "kx", "unit": "V/g", "degrees_of_freedom": freedom} | told))
        return store.add(
            entry(replace(calibration(), parameters={kx.name: kx, **conditions})),
            provenance(sources=tuple(raw_source(sha256=each * 32) for each in raw or ("aa",))),
        )

    return make


def test_a_difference_has_the_root_sum_of_squares_as_its_uncertainty(record):
    (kx,) = compare(record(), record("bb", value=1.001, standard_uncertainty=4e-4))
    assert kx.difference == pytest.approx(1e-3)
    assert kx.standard_uncertainty == pytest.approx(5e-4)
    assert kx.significance == pytest.approx(2.0)


def test_the_p_value_is_two_sided_and_normal_where_the_freedom_is_infinite(record):
    (kx,) = compare(record(), record("bb", value=1.0 - 1.96 * 5e-4, standard_uncertainty=4e-4))
    assert kx.p_value == pytest.approx(0.05, abs=1e-4)  # the usual table of the normal distribution


def test_few_degrees_of_freedom_make_the_p_value_larger(record):
    # Equal u with 5 degrees of freedom each: 10 effective ones, whose two-sided 5 % point is 2.228 (table of t).
    first = record(freedom=5.0)
    (kx,) = compare(first, record("bb", freedom=5.0, value=1.0 + 2.228 * 3e-4 * 2**0.5))
    assert kx.p_value == pytest.approx(0.05, abs=1e-4)


@pytest.mark.parametrize(
    ("value", "judgement"),
    [(1.002, ": significant (p = "), (1.0001, ": not significant (p = 0.81; 0.05 is asked for)")],
)
def test_the_sentence_says_whether_the_change_is_significant(record, value, judgement):
    (kx,) = compare(record(), record("bb", value=value))
    assert kx.sentence.startswith("kx changed by +")
    assert judgement in kx.sentence


def test_of_six_values_none_is_significant_at_a_chance_that_one_of_them_has(tmp_path):
    store = Store(tmp_path)
    told = {"unit": "V", "standard_uncertainty": 1e-3, "type_a": 1e-3, "interval_95": (-9.0, 9.0)}

    def made(raw, value):
        six = [Parameter(name=f"p{n}", value=value, degrees_of_freedom=float("inf"), **told) for n in range(6)]
        values = replace(calibration(), parameters={each.name: each for each in six})
        return store.add(entry(values), provenance(sources=(raw_source(sha256=raw * 32),)))

    found = compare(made("aa", 1.0), made("bb", 1.0 + 2.2e-3 * 2**0.5))  # 2.2 standard uncertainties: p = 0.028
    assert [each.sentence.endswith(": not significant (p = 0.028; 0.008 is asked for).") for each in found] == [
        True
    ] * 6


def test_two_analyses_of_the_same_raw_data_differ_by_the_analysis(record):
    (kx,) = compare(record(), record(value=1.0005))
    assert kx.sentence == (
        "kx changed by +0.50 mV/g, standard uncertainty 0.42 mV/g: "
        "both records come from the same raw data, so this is what the analysis changed."
    )


def test_two_equal_analyses_of_the_same_raw_data_show_no_change(record):
    (kx,) = compare(record(), record())
    assert kx.sentence == "kx did not change: both records come from the same raw data."


@pytest.mark.parametrize(
    ("second", "sha256", "conclusion"),
    [
        ({}, "aa", "No change: both records come from the same raw data."),
        ({"value": 1.1}, "aa", "Both records come from the same raw data: this is what the analysis changed."),
        ({}, "bb", "Not significant (p = 1; 0.05 is asked for)."),
        ({"value": 2.0}, "bb", "Significant (p = 0)."),
        ({"value": 2.0, "standard_uncertainty": 0.0}, "bb", ""),
        ({"unit": "mV/g"}, "bb", "Cannot be compared: it is in V/g in the first record and in mV/g in the second."),
    ],
)
def test_what_a_difference_means_is_said_alone(record, second, sha256, conclusion):
    first = {"standard_uncertainty": 0.0} if "standard_uncertainty" in second else {}
    kx, *_ = compare(record(**first), record(sha256, **second))
    assert kx.conclusion == conclusion


def test_records_with_some_raw_files_in_common_are_not_taken_for_independent(record):
    (kx,) = compare(record("aa"), record("aa", "bb", value=2.0))
    remark = "They have raw files in common: the uncertainty is too large, and the test conservative."
    assert kx.conclusion == f"Significant (p = 0). {remark}"
    assert kx.sentence.endswith(f": significant (p = 0). {remark}")


def test_a_difference_without_uncertainty_has_no_significance(record):
    (kx,) = compare(record(standard_uncertainty=0.0), record("bb", value=1.5, standard_uncertainty=0.0))
    assert (kx.difference, kx.significance, kx.p_value) == (0.5, None, None)
    assert kx.sentence == "kx changed by +500 mV/g, standard uncertainty 0 mV/g."


def test_a_small_difference_has_the_prefix_and_the_digits_of_its_uncertainty(record):
    first, second = record(standard_uncertainty=15e-6), record("bb", value=1.0 - 14.6e-6, standard_uncertainty=15e-6)
    (kx,) = compare(first, second)
    assert kx.sentence.startswith("kx changed by -15 µV/g, standard uncertainty 21 µV/g: not significant")


UNTOLD = {"value": None, "standard_uncertainty": None, "type_a": None, "freedom": None, "interval_95": None}


@pytest.mark.parametrize(
    ("fields", "obstacle"),
    [
        (UNTOLD | {"reason": "one mount"}, "the second record has no value (one mount)"),
        (UNTOLD, "the second record has no value"),
        ({"unit": "mV/g"}, "it is in V/g in the first record and in mV/g in the second"),
        ({"given": {"alpha0": 0.0}}, "the first value stands for alpha0 as fitted, the second for alpha0 = 0°"),
    ],
)
def test_what_cannot_be_subtracted_is_said_so(record, fields, obstacle):
    kx, *_ = compare(record(), record("bb", **fields))
    assert (kx.difference, kx.standard_uncertainty, kx.significance, kx.p_value) == (None, None, None, None)
    assert kx.sentence == f"kx cannot be compared: {obstacle}."


def test_values_for_the_same_given_alpha0_are_compared(record):
    kx, *_ = compare(record(given={"alpha0": 0.0}), record("bb", given={"alpha0": 0.0}, value=1.1))
    assert kx.difference == pytest.approx(0.1)


def test_a_parameter_that_only_one_record_has_is_named(record):
    _, ky = compare(record(), record("bb", name="ky"))
    assert ky.sentence == "ky cannot be compared: only one of the records has it."


def test_a_changed_scale_factor_is_found_and_nothing_else(tmp_path):
    store = Store(tmp_path)
    first = store.add(entry(calibration(seed=1)), provenance())
    second = store.add(entry(calibration(seed=2, kx=1.001)), provenance(sources=(raw_source(sha256="bb" * 32),)))
    p_values = {difference.name: difference.p_value for difference in compare(first, second)}
    assert p_values.pop("kx") < 1e-6
    assert min(p_values.values()) > 1e-3


def test_a_full_calibration_and_a_single_sweep_share_all_but_kz(tmp_path):
    store = Store(tmp_path)
    differences = compare(
        store.add(entry(calibration()), provenance()),
        store.add(entry(sweep_only()), provenance(sources=(raw_source(sha256="bb" * 32),))),
    )
    assert [d.name for d in differences if d.difference is None] == ["kz"]
