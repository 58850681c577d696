"""A record deleted, altered or moved past the triggers is noticed by the chain of its writer."""

import shutil
import sqlite3
from contextlib import closing

import pytest
from records_examples import calibration, minutes_pass, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records import chain
from tumble.calibrations.records.export import document, is_intact
from tumble.calibrations.records.store import DATABASE, Store


@pytest.fixture
def store(tmp_path):
    store = Store(tmp_path / "store", now=minutes_pass())
    for number in range(1, 5):
        store.add(entry(calibration()), provenance(serial_number=f"SN {number}"))
    return store


def past_the_triggers(store, *statements):
    with closing(sqlite3.connect(store.path)) as connection, connection:
        for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
            connection.execute(f"DROP TRIGGER {name}")
        for statement in statements:
            connection.execute(statement)


def delete(store, *numbers):
    places = ", ".join(map(str, numbers))
    past_the_triggers(
        store,
        f"DELETE FROM parameters WHERE record_id IN (SELECT id FROM records WHERE sequence IN ({places}))",
        f"DELETE FROM records WHERE sequence IN ({places})",
    )


def faults(store):
    (found,) = store.inventory().chains
    return found.faults


def test_every_record_follows_from_the_one_before(store):
    records = store.find()
    first, *others = [record.link for record in records]
    assert (first.sequence, first.previous_sha256) == (1, "")
    assert [link.sequence for link in others] == [2, 3, 4]
    assert [link.previous_sha256 for link in others] == [record.content_sha256 for record in records[:-1]]
    assert len({link.writer for link in (first, *others)}) == 1
    assert faults(store) == ()


def test_the_hash_of_a_record_covers_its_place_in_the_chain(store):
    exported = document(store.find()[1])
    assert is_intact(exported)
    for altered in ({"sequence": 1}, {"previous_sha256": ""}, {"writer": "00" * 8}):
        assert not is_intact(exported | altered)


@pytest.mark.parametrize(
    ("numbers", "said"),
    [
        ([1], "Record 1 of 4 is missing"),
        ([2], "Record 2 of 4 is missing"),
        ([4], "Record 4 of 4 is missing"),
        ([3, 4], "Records 3, 4 of 4 are missing"),
        ([1, 2, 3, 4], "Records 1, 2, 3, 4 of 4 are missing"),
    ],
)
def test_a_record_deleted_from_every_table_is_noticed(store, numbers, said):
    delete(store, *numbers)
    (fault,) = faults(store)
    assert fault.startswith(f"{said} from the chain of ")


def test_a_record_deleted_and_the_others_numbered_anew_is_noticed(store):
    delete(store, 2)
    past_the_triggers(store, "UPDATE records SET sequence = sequence - 1 WHERE sequence > 2")
    assert [fault.split(" ", 2)[2].partition(":")[0].partition(" from")[0] for fault in faults(store)] == [
        "of 4 is missing",
        "does not follow",
    ]


def test_an_end_cut_off_with_the_number_lowered_is_noticed(store):
    delete(store, 4)
    past_the_triggers(store, "UPDATE chains SET sequence = 3")
    (fault,) = faults(store)
    assert fault.endswith("is not the one with which its chain ended: it was altered or replaced")


def test_an_altered_order_is_noticed(store):
    past_the_triggers(
        store,
        "UPDATE records SET sequence = 9 WHERE sequence = 2",
        "UPDATE records SET sequence = 2 WHERE sequence = 3",
        "UPDATE records SET sequence = 3 WHERE sequence = 9",
    )
    assert len(faults(store)) == 3


def test_a_record_replaced_together_with_its_hash_is_noticed(store):
    past_the_triggers(store, "UPDATE records SET content_sha256 = 'ab' WHERE sequence = 2")
    (fault,) = faults(store)
    assert "does not follow from" in fault


def test_a_chain_whose_end_was_removed_is_noticed(store):
    past_the_triggers(store, "DELETE FROM chains")
    (fault,) = faults(store)
    assert fault.startswith("The end of the chain of writer ")


def test_a_copy_of_a_store_goes_on_with_a_chain_of_its_own(store, tmp_path):
    shutil.copytree(store.folder, tmp_path / "laptop")
    offline = Store(tmp_path / "laptop").add(entry(calibration()), provenance())
    here = store.add(entry(calibration()), provenance())
    assert (offline.link.sequence, here.link.sequence) == (1, 5)
    assert offline.link.writer != here.link.writer
    assert [found.faults for found in Store(tmp_path / "laptop").inventory().chains] == [(), ()]


def test_another_user_of_a_store_has_a_chain_of_his_own(store, monkeypatch):
    monkeypatch.setattr(chain.getpass, "getuser", lambda: "another")
    assert store.add(entry(calibration()), provenance()).link.sequence == 1
    assert sorted(found.length for found in store.inventory().chains) == [1, 4]


def test_a_computer_without_user_names_has_a_chain(tmp_path, monkeypatch):
    def nobody():
        raise KeyError("uid not found")

    monkeypatch.setattr(chain.getpass, "getuser", nobody)
    assert Store(tmp_path).add(entry(calibration()), provenance()).link.sequence == 1


def test_a_store_made_anew_in_its_place_begins_a_new_chain(store):
    before = store.find()[0].link.writer
    (store.folder / DATABASE).unlink()
    assert Store(store.folder).add(entry(calibration()), provenance()).link.writer != before
