"""What changed since a unit was calibrated before: which record is the last, and how far each value has moved."""

import math
from dataclasses import replace

import numpy as np
import pytest
from records_examples import calibration, provenance, raw_source
from report_examples import provenance as reported
from report_examples import reversed_

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.methods.dividing_head.report import calibration_report
from tumble.calibrations.records.changes import Change, changes
from tumble.calibrations.records.store import Store
from tumble.calibrations.report.language import written_in
from tumble.calibrations.report.written import written
from tumble.messages import Language

FIRST, SECOND, THIRD = (f"2026-11-{day}T10:00:00+02:00" for day in (20, 21, 22))


@pytest.fixture
def store(tmp_path):
    return Store(tmp_path)


@pytest.fixture
def record(store):
    """Stores a result whose only parameter is kx, measured when it is said, of raw files of its own."""

    def make(
        measured_at, value=1.0, u=3e-4, freedom=math.inf, raw=None, unit="SN 17", name="kx", supersedes=None, **told
    ):
        parameter = Parameter(
            name=name,
            unit="V/g",
            value=value,
            standard_uncertainty=u,
            degrees_of_freedom=freedom,
            interval_95=(value - 2 * u, value + 2 * u),
        )
        sources = tuple(raw_source(sha256=each * 32) for each in raw or (measured_at[8:10],))
        origin = provenance(measured_at=measured_at, sources=sources, serial_number=unit, **told)
        return store.add(entry(replace(calibration(), parameters={name: parameter})), origin, supersedes)

    return make


def before(store, record):
    return [each.id for each in store.before(record, 20)]


def test_earlier_records_of_the_unit_come_the_newest_first(store, record):
    first, second, third = record(FIRST), record(SECOND), record(THIRD)
    assert before(store, third) == [second.id, first.id]
    assert before(store, first) == []


def test_another_unit_is_no_earlier_calibration(store, record):
    record(FIRST, unit="SN 18")
    assert before(store, record(SECOND)) == []


def test_another_method_is_none_either(store, record):
    first, second = record(FIRST), record(SECOND)
    other = replace(second, method="triad")
    assert before(store, second) == [first.id]
    assert before(store, other) == []


def test_a_simulated_stand_is_held_against_its_like_alone(store, record):
    simulated = {"name": "bench-1", "head": {"driver": "simulated"}, "daq": {"driver": "simulated"}}
    real, imagined = record(FIRST), record(SECOND, stand=simulated)
    assert before(store, imagined) == []
    assert before(store, record(THIRD)) == [real.id]
    assert before(store, record(THIRD, stand=simulated, raw=("ab",))) == [imagined.id]


def test_a_joint_result_is_not_held_against_what_it_holds(store, record):
    record(FIRST, raw=("aa",))
    assert before(store, record(SECOND, raw=("aa", "bb"))) == []


def test_what_was_superseded_does_not_count(store, record):
    wrong = record(FIRST, value=2.0)
    right = record(FIRST, supersedes=wrong.id)
    assert before(store, record(SECOND)) == [right.id]


def test_no_more_are_read_than_are_asked_for(store, record):
    record(FIRST)
    second, third = record(SECOND), record(THIRD)
    assert [each.id for each in store.before(third, 1)] == [second.id]


def test_a_change_has_the_expanded_uncertainty_of_the_difference(store, record):
    record(FIRST)
    told = record(SECOND, value=1.001, u=4e-4)
    change = changes(told, store.before(told, 20))["kx"]
    assert change.difference == pytest.approx(1e-3)
    assert change.expanded_uncertainty == pytest.approx(1.95996 * 5e-4, rel=1e-5)  # k of the normal distribution
    assert change.since == FIRST


def test_few_degrees_of_freedom_widen_it(store, record):
    # Equal u with 5 degrees of freedom each: 10 effective ones, whose two-sided 5 % point is 2.228 (table of t).
    record(FIRST, freedom=5.0)
    told = record(SECOND, freedom=5.0)
    change = changes(told, store.before(told, 20))["kx"]
    assert change.expanded_uncertainty == pytest.approx(2.228 * 3e-4 * 2**0.5, rel=1e-3)


def test_what_both_calibrations_share_is_counted_in_each_and_hides_no_doubt(store, record):
    # Of u = 5e-4 each, 4e-4 is the gain of one DAQ, which drops out of the difference: sqrt(2) 3e-4 is left of it.
    record(FIRST, u=5e-4)
    told = record(SECOND, value=1.001, u=5e-4)
    change = changes(told, store.before(told, 20))["kx"]
    assert change.expanded_uncertainty == pytest.approx(1.95996 * 2**0.5 * 5e-4, rel=1e-5)
    drawn = np.random.default_rng(0)
    gain, own = 4e-4 * drawn.standard_normal(100_000), 3e-4 * drawn.standard_normal((2, 100_000))
    differences = (gain + own[1]) - (gain + own[0])
    assert np.mean(abs(differences) < change.expanded_uncertainty) > 0.99


def test_a_value_is_held_against_the_last_record_that_has_it(store, record):
    first = record(FIRST)
    record(SECOND, name="ky")
    told = record(THIRD)
    assert changes(told, store.before(told, 20))["kx"].record_id == first.id


def test_a_value_that_no_record_had_has_no_change(store, record):
    record(FIRST, name="ky")
    told = record(SECOND)
    assert changes(told, store.before(told, 20)) == {}


def test_a_value_that_stands_for_something_given_is_of_another_definition(store, record):
    first, second = record(FIRST), record(SECOND)
    models = {"declared": [{**second.models_json["declared"][0], "given": {"alpha0": 0.0}}]}
    assert changes(replace(second, models_json=models), [first]) == {}


@pytest.mark.parametrize(
    ("difference", "expanded_uncertainty", "text"),
    [
        (1.2e-4, 3.6e-4, "(+0.12 ± 0.36) mV/g"),
        (-1.2e-4, 3.6e-4, "(-0.12 ± 0.36) mV/g"),
        (0.0, 3.6e-4, "(+0.00 ± 0.36) mV/g"),
        (1.2e-4, 0.0, "+120 µV/g"),
    ],
)
def test_a_change_is_written_with_its_sign(difference, expanded_uncertainty, text):
    assert change_of(difference, expanded_uncertainty).text == text


@pytest.mark.parametrize(
    ("language", "told"),
    [
        (Language.ENGLISH, "(+0.12 ± 0.36) mV/g since 2026-11-20"),
        (Language.GERMAN, "(+0,12 ± 0,36) mV/g seit 20.11.2026"),
        (Language.UKRAINIAN, "(+0,12 ± 0,36) мВ/g від 20.11.2026"),
    ],
)
def test_the_first_page_says_it_with_its_day(language, told):
    report = calibration_report(reversed_(), reported()).with_changes({"kx": change_of(1.2e-4, 3.6e-4)})
    with written_in(language):
        front = written(report)["front"]
    assert [each["change"] for each in front["values"]] == ["", told, "", "", "", ""]
    assert len(front["statements"]) == 3


def test_without_an_earlier_calibration_nothing_is_said_of_it():
    front = written(calibration_report(reversed_(), reported()))["front"]
    assert not any(each["change"] for each in front["values"])
    assert len(front["statements"]) == 2


def change_of(difference, expanded_uncertainty):
    return Change(
        difference=difference,
        expanded_uncertainty=expanded_uncertainty,
        unit="V/g",
        since=FIRST,
        record_id="20261120-100000-aaaaaa",
    )
