"""What the screen Records says of a record: effects, stand, in short, and beside another."""

import pytest
from PySide6.QtCore import QRectF
from records_examples import provenance, raw_source
from test_records_any_method import pendulum

from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.store import Store
from tumble.window.widgets.interval_bars import _lanes
from tumble.window.work.compared import Interval
from tumble.window.work.comparison import comparison
from tumble.window.work.preview import preview
from tumble.window.work.record_words import StandState, findings_in, programme_text, stand_state, stand_words

SEAL = {"name": "seal", "coefficients": {}}
HEAD = {"driver": "zaber"}


@pytest.fixture
def record_of(qapp, tmp_path):
    """Makes a record of a pendulum."""
    store = Store(tmp_path)

    def make(*, stand=None, sources=None, **changed):
        told = {"stand": stand, "sources": sources}
        origin = {name: value for name, value in told.items() if value is not None}
        return store.add(pendulum(**changed), provenance(serial_number="P-1", **origin))

    return make


@pytest.mark.parametrize(
    ("result", "effects", "unnamed"),
    [
        ({}, (), False),
        ({"effects": [SEAL]}, ("seal",), False),
        ({"loop": {"effects": [SEAL], "unexplained": {"courses": []}}}, ("seal",), True),
        ({"parameters": {"u0": {"effects": [SEAL]}, "kx": {"effects": [SEAL]}}}, ("seal",), False),
    ],
)
def test_effects_are_those_of_every_loop_of_a_result(record_of, result, effects, unnamed):
    found = findings_in(record_of(result=result))
    assert (found.effects, found.unnamed) == (effects, unnamed)


@pytest.mark.parametrize(
    ("stand", "result", "state", "words"),
    [
        ({"head": HEAD}, {}, StandState.UNCORRECTED, "bench-1, not corrected by a stand record"),
        ({"head": {"driver": "simulated"}}, {}, StandState.SIMULATED, "bench-1: a simulated stand"),
        (
            {"positioners": {"outer": {"driver": "simulated"}, "inner": HEAD}},
            {},
            StandState.UNCORRECTED,
            "bench-1, not corrected by a stand record",
        ),
        (
            {"head": HEAD},
            {"stand_record": {"id": "1", "version": 3, "content_sha256": ""}},
            StandState.CORRECTED,
            "bench-1, corrected by version 3 of its stand record",
        ),
    ],
)
def test_what_is_known_of_the_stand_is_said(record_of, stand, result, state, words):
    record = record_of(stand=stand, result=result)
    assert (stand_state(record), stand_words(record)) == (state, words)


def test_a_record_in_short_has_the_values_to_use_with_their_expanded_uncertainties(record_of):
    short = preview(record_of(result={"warnings": ["the room was cold"]}))
    assert short.values[0] == ("period", "(2.0070 ± 0.0020) s", "")
    assert short.findings == ("no effect was found",)
    assert short.warnings == "1 warning: open the record to read it"


def test_two_records_are_held_against_each_other_in_standard_uncertainties(record_of):
    other = {"value": 2.010, "standard_uncertainty": 0.001, "unit": "s", "interval_95": [2.008, 2.012]}
    found = comparison(record_of(), record_of(parameters={"period": other}))
    line = found.lines[0]
    assert (line.name, line.first, line.second) == ("period", "(2.0070 ± 0.0020) s", "(2.0100 ± 0.0020) s")
    assert (line.difference, line.ratio) == ("(0.0030 ± 0.0028) s", "+2.12")
    assert line.intervals[1] == Interval(value=2.010, low=2.008, high=2.012)


def test_a_parameter_that_one_record_lacks_has_no_difference(record_of):
    found = comparison(record_of(), record_of(parameters={}))
    assert (found.lines[0].difference, found.lines[0].ratio, found.lines[0].second) == ("", "", "")
    assert found.lines[0].sentence == "period cannot be compared: only one of the records has it."


def test_records_of_different_methods_are_not_compared(record_of):
    with pytest.raises(RecordError, match="compare records of one method"):
        comparison(record_of(), record_of(method="clock"))


def test_intervals_lie_on_one_axis():
    first, second = Interval(value=1.0, low=0.0, high=2.0), Interval(value=3.0, low=2.0, high=4.0)
    (bar, value), (other_bar, other_value) = _lanes([first, second], QRectF(0.0, 0.0, 112.0, 40.0))
    assert (bar.x1(), bar.x2(), other_bar.x2()) == (6.0, 56.0, 106.0)
    assert (value.x(), other_value.x()) == (31.0, 81.0)
    assert (value.y(), other_value.y()) == (10.0, 30.0)


def test_an_interval_that_is_not_there_leaves_its_lane_empty():
    (first, second) = _lanes([None, Interval(value=1.0, low=1.0, high=1.0)], QRectF(0.0, 0.0, 100.0, 40.0))
    assert first is None
    assert second[1].x() == 50.0


def test_a_joint_record_is_told_from_the_first_of_its_runs(record_of, qapp):
    sources = [raw_source(sha256=each * 32) for each in ("aa", "bb")]
    first, joint = record_of(sources=sources[:1]), record_of(sources=sources)
    assert [programme_text(each) for each in (first, joint)] == ["seed", "seed + 1"]
    found = comparison(first, joint)
    assert found.first.endswith(", seed")
    assert found.second.endswith(", seed + 1")


def test_records_that_nothing_else_tells_apart_are_called_by_their_ids(record_of, qapp):
    first, second = record_of(), record_of(sources=[raw_source(sha256="bb" * 32)])
    found = comparison(first, second)
    assert (found.first, found.second) == (f"P-1, {first.id}", f"P-1, {second.id}")
