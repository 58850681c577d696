"""Records that hold the closed loop: format 2."""

import shutil
import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest
from loop_examples import with_k_xx
from records_examples import KX_INSIDE, as_recorded, calibration, minutes_pass, provenance, store_with_raw_file

from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.methods.dividing_head.document import document as loop_document
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.export import document, is_intact
from tumble.calibrations.records.store import DATABASE, Store
from tumble.calibrations.records.verify import verify

FIXTURES = Path(__file__).parent / "fixtures"
NAMES = ["u0", "kx", "ky", "kz", "kxy", "alpha0"]


@pytest.fixture
def store(tmp_path):
    return store_with_raw_file(tmp_path)


@pytest.fixture
def record(store):
    return store.add(entry(with_k_xx().declared, [KX_INSIDE], with_k_xx()), provenance())


@pytest.fixture
def store_v1(tmp_path):
    shutil.copy(FIXTURES / "records_v1.sqlite", tmp_path / DATABASE)
    return Store(tmp_path, now=minutes_pass())


@pytest.fixture
def store_v2(tmp_path):
    shutil.copy(FIXTURES / "records_v2.sqlite", tmp_path / DATABASE)
    return Store.existing(tmp_path)


def same(_paths, _stand):
    return entry(with_k_xx().declared, loop=with_k_xx())


def with_loop_moved(name, share):
    """The result with one parameter of the augmented model moved by a share of its uncertainty."""
    augmented = with_k_xx().augmented
    parameter = augmented.parameters[name]
    moved = replace(parameter, value=parameter.value + share * parameter.standard_uncertainty)
    loop = replace(with_k_xx(), augmented=replace(augmented, parameters={**augmented.parameters, name: moved}))
    return entry(with_k_xx().declared, loop=loop)


def test_a_record_keeps_the_declared_and_the_augmented_model(store, record):
    read = Store.existing(store.folder).get(record.id)
    assert read == record
    assert list(read.models) == ["declared", "augmented"]
    assert as_recorded(read.parameters) == as_recorded(with_k_xx().declared.parameters)
    assert as_recorded(read.models["augmented"]) == as_recorded(with_k_xx().augmented.parameters)


def test_a_record_holds_the_whole_loop(record):
    assert record.format_version == 5
    assert record.result["loop"] == loop_document(with_k_xx())
    assert document(record)["schema"] == "tumble.record/5"
    assert is_intact(document(record))


def test_both_models_stand_in_the_table_of_parameters(store, record):
    _, rows = store.rows(record)
    assert sorted((row["model"], row["name"]) for row in rows) == sorted(
        (model, name) for model in ("declared", "augmented") for name in NAMES
    )


def test_a_record_without_a_loop_has_the_declared_model_alone(store):
    record = store.add(entry(calibration()), provenance())
    assert list(record.models) == ["declared"]
    assert {row["model"] for row in store.rows(record)[1]} == {"declared"}


def test_both_models_are_verified(store, record):
    verification = verify(record, store, same, "0.1.0")
    assert verification.verified
    assert [(check.model, check.name) for check in verification.parameters] == [
        (model, name) for model in ("declared", "augmented") for name in NAMES
    ]


def test_a_number_of_the_augmented_model_that_moved_does_not_come_back(store, record):
    verification = verify(record, store, lambda *_: with_loop_moved("ky", 2e-6), "0.1.0")
    assert not verification.verified
    assert "Fitted again, these do not come back: ky of the augmented model." in verification.sentences


def test_a_loop_that_is_not_closed_again_does_not_come_back(store, record):
    verification = verify(record, store, lambda *_: entry(with_k_xx().declared), "0.1.0")
    assert [check.name for check in verification.parameters if not check.agrees] == NAMES


def test_an_augmented_parameter_altered_in_the_store_is_seen(store, record):
    with closing(sqlite3.connect(store.path)) as connection, connection:
        connection.execute("DROP TRIGGER parameters_no_update")
        connection.execute("UPDATE parameters SET value = 1.5 WHERE name = 'kx' AND model = 'augmented'")
    assert verify(record, store, same, "0.1.0").altered == ("parameters",)


def test_a_record_of_format_1_is_verified_by_its_declared_model(store_v1):
    record = store_v1.revisions(store_v1.find()[0])[0]
    (raw,) = store_with_raw_file(store_v1.folder).raw_files(record)
    assert raw.is_file()
    again = entry(calibration(), loop=with_k_xx())
    verification = verify(record, store_v1, lambda *_: again, "0.1.0")
    assert (record.format_version, verification.altered) == (1, ())
    assert [check.model for check in verification.parameters] == ["declared"] * 6


def test_records_of_format_2_still_load(store_v2):
    (second,) = store_v2.find(serial_number="SN 17")
    first, _ = store_v2.revisions(second)
    assert [record.format_version for record in (first, second)] == [2, 2]
    assert [list(record.models) for record in (first, second)] == [["declared"], ["declared", "augmented"]]
    assert [effect["name"] for effect in second.result["loop"]["effects"]] == ["k_xx"]
    assert second.models["augmented"]["ky"].value == pytest.approx(0.0098, abs=5e-4)


def test_the_hash_of_a_record_of_format_2_still_holds(store_v2):
    assert all(is_intact(document(record)) for record in store_v2.revisions(store_v2.find()[0]))


@pytest.fixture
def store_v3(tmp_path):
    shutil.copy(FIXTURES / "records_v3.sqlite", tmp_path / DATABASE)
    return Store.existing(tmp_path)


def test_records_of_format_3_hold_the_verdict_with_its_reasons(store_v3):
    (second,) = store_v3.find(serial_number="SN 17")
    first, _ = store_v3.revisions(second)
    assert [record.format_version for record in (first, second)] == [3, 3]
    assert (first.verdict.outcome, first.verdict.named(Outcome.FAIL)) == (Outcome.FAIL, ("ky",))
    assert second.verdict.outcome is Outcome.NO_LIMITS
    assert all(is_intact(document(record)) for record in (first, second))


def test_an_old_verdict_says_that_it_is_of_the_declared_model_alone(tmp_path):
    shutil.copy(FIXTURES / "records_v2.sqlite", tmp_path / DATABASE)
    store = Store.existing(tmp_path)
    first, _ = store.revisions(store.find()[0])
    (_, ky) = first.verdict.parameters
    assert (ky.outcome, ky.reason) == (
        Outcome.FAIL,
        "judged by an earlier version, by the value of the declared model alone",
    )
    assert document(first)["verdict"] == "outside"


def test_the_values_to_use_of_an_old_record_follow_from_its_loop(store_v2):
    (second,) = store_v2.find()
    assert second.model == "augmented"
    assert second.values == second.models["augmented"]
