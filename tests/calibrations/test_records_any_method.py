"""A result of any method is recorded, shown, compared with its like and verified from all of its raw files."""

import hashlib
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import pytest
from records_examples import calibration, provenance

from tumble.calibrations.core.provenance import Source
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.compare import compare
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.export import document, is_intact
from tumble.calibrations.records.store import Store
from tumble.calibrations.records.verify import RawFile, verify

PERIOD = {"value": 2.007, "standard_uncertainty": 0.001, "unit": "s", "interval_95": [2.005, 2.009]}
LENGTH = {"value": None, "standard_uncertainty": None, "unit": "m", "reason": "it takes a second length"}
DAMPING = {"value": 0.02, "standard_uncertainty": 0.001, "unit": "", "given": {"period": 2.0}}


def pendulum(**changed):
    """A result of a method that nobody in the product knows."""
    content = {
        "method": "pendulum",
        "method_version": 3,
        "result": {"schema": "pendulum/1", "swings": [2.006, 2.008]},
        "parameters": {"period": PERIOD, "length": LENGTH, "damping": DAMPING},
    }
    return Entry(**content | changed)


def raw(folder, name, content):
    (folder / name).write_bytes(content)
    return Source(kind="table", path=name, sha256=hashlib.sha256(content).hexdigest())


@pytest.fixture
def store(tmp_path):
    return Store(tmp_path)


@pytest.fixture
def record(store):
    """A record of two raw files, one with a comma in its name."""
    sources = (raw(store.folder, "left, right.csv", b"1"), raw(store.folder, "back.csv", b"2"))
    return store.add(pendulum(), provenance(sources=sources))


def test_a_result_of_another_method_comes_back_as_it_was_added(store, record):
    again = store.get(record.id)
    assert again == record
    assert (again.method, again.method_version) == ("pendulum", 3)
    assert again.result == {"schema": "pendulum/1", "swings": [2.006, 2.008]}
    assert is_intact(document(again))


def test_its_values_are_those_of_its_own_parameters_in_their_order(record):
    assert list(record.values) == ["period", "length", "damping"]
    assert (record.values["period"].value, record.values["period"].unit) == (2.007, "s")
    assert record.values["length"].reason == "it takes a second length"
    assert record.values["damping"].condition == "given period = 2 s"


def test_a_result_without_parameters_limits_and_verdict_is_recorded(store):
    record = store.add(pendulum(parameters={}), provenance())
    assert (record.values, record.limits, record.verdict.outcome) == ({}, (), Outcome.NO_LIMITS)
    assert store.rows(record)[1] == []


def test_the_model_that_was_judged_gives_the_values_to_use(store):
    verdict = Verdict(
        judged=Model.AUGMENTED, parameters=(Judgement(name="period", outcome=Outcome.PASS, reason="inside"),)
    )
    moved = PERIOD | {"value": 2.011}
    record = store.add(pendulum(augmented={"period": moved}, verdict=verdict), provenance())
    assert record.values["period"].value == 2.011
    assert record.parameters["period"].value == 2.007
    assert [found.id for found in store.find(verdict=Outcome.PASS)] == [record.id]


def test_records_are_found_by_their_method(store, record):
    other = store.add(entry(calibration()), provenance())
    assert [found.id for found in store.find(method="pendulum")] == [record.id]
    assert [found.id for found in store.find(method="dividing_head")] == [other.id]


def test_every_raw_file_is_verified(store, record):
    asked = []

    def refit(paths, _stand):
        asked.extend(path.name for path in paths)
        return pendulum()

    found = verify(record, store, refit, "0.2.0")
    assert found.verified
    assert asked == ["left, right.csv", "back.csv"]
    (store.folder / "back.csv").write_bytes(b"3")
    found = verify(record, store, refit, "0.2.0")
    assert [source.state for source in found.sources] == [RawFile.INTACT, RawFile.CHANGED]
    assert not found.verified


def test_a_number_that_does_not_come_back_is_named(store, record):
    moved = pendulum(parameters={"period": PERIOD | {"value": 2.008}, "length": LENGTH, "damping": DAMPING})
    found = verify(record, store, lambda *_: moved, "0.2.0")
    assert "Fitted again, these do not come back: period." in found.sentences


def test_a_method_that_the_program_does_not_know_is_hashed_and_not_said_to_be_verified(store, record):
    found = verify(record, store, None, "0.2.0")
    assert (found.intact, found.altered, found.verified) == (True, (), False)
    assert found.sentences[-2] == "This program cannot carry out the method pendulum; update it."


def test_records_of_different_methods_are_not_compared(store, record):
    with pytest.raises(RecordError, match=r"is of method pendulum, .* of dividing_head: .*; compare records of one"):
        compare(record, store.add(entry(calibration()), provenance()))


def test_records_of_one_method_are_compared(store, record):
    second = store.add(pendulum(parameters={"period": PERIOD | {"value": 2.017}}), provenance())
    period = compare(record, second)[0]
    assert period.difference == pytest.approx(0.01)
    assert period.sentence.startswith("period changed by +0.0100 s, standard uncertainty 0.0014 s: significant")


def test_a_record_is_not_superseded_by_one_of_another_method(store, record):
    with pytest.raises(RecordError, match="is of method pendulum, not dividing_head"):
        store.add(entry(calibration()), provenance(sources=record.provenance.sources), supersedes=record.id)


def test_a_record_is_superseded_by_one_of_the_same_files_in_another_order(store, record):
    again = store.add(pendulum(), provenance(sources=record.provenance.sources[::-1]), supersedes=record.id)
    assert again.revision == 2


def test_a_record_is_not_superseded_by_one_of_part_of_its_files(store, record):
    with pytest.raises(RecordError, match="comes from another raw file"):
        store.add(pendulum(), provenance(sources=record.provenance.sources[:1]), supersedes=record.id)


def _add_some(folder):
    return [Store(folder).add(pendulum(), provenance()).link.sequence for _ in range(5)]


def test_two_processes_that_add_to_one_store_make_one_whole_chain(store):
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        numbers = [number for added in pool.map(_add_some, [store.folder] * 2) for number in added]
    (chain,) = store.inventory().chains
    assert sorted(numbers) == list(range(1, 11))
    assert (chain.length, chain.faults) == (10, ())


FORBIDDEN = ("dividing_head", "alpha0", "kx", "Calibration", "Loop", "calibrations.result", "calibrations.model")
"""Words of one method."""


def test_the_store_names_no_method():
    package = Path(__file__).parents[2] / "calibrations" / "records"
    code = [path for path in package.rglob("*.py") if "migrations" not in path.parts]
    named = {(path.name, word) for path in code for word in FORBIDDEN if word in path.read_text("utf-8")}
    assert named == set()
