"""A store that cannot be used: one sentence, and nothing half-written."""

import os
import sqlite3
from contextlib import closing, contextmanager

import pytest
from records_examples import calibration, provenance
from sqlalchemy import Engine, event

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records import database
from tumble.calibrations.records.errors import StoreError
from tumble.calibrations.records.store import DATABASE, Store


@contextmanager
def every_connection(pragma):
    """Have SQLite itself behave so: PRAGMA on every connection that is opened meanwhile."""

    def set_pragma(connection, _record):
        connection.execute(f"PRAGMA {pragma}")

    event.listen(Engine, "connect", set_pragma)
    yield
    event.remove(Engine, "connect", set_pragma)


@contextmanager
def refused(part):
    with pytest.raises(StoreError, match=part) as caught:
        yield
    message = str(caught.value)
    assert message.startswith(str(caught.value.path))
    assert caught.value.happened in message
    assert message.endswith(caught.value.remedy)


def counts(store):
    with closing(sqlite3.connect(store.path)) as connection:
        return [connection.execute(f"SELECT count(*) FROM {name}").fetchone()[0] for name in ("records", "parameters")]


@pytest.fixture
def store(tmp_path):
    store = Store(tmp_path / "store", busy_timeout_s=0.01)
    store.add(entry(calibration()), provenance())
    return store


def test_a_full_disk_while_adding_leaves_nothing_of_the_record(store):
    with closing(sqlite3.connect(store.path)) as connection:
        pages = connection.execute("PRAGMA page_count").fetchone()[0]
    with every_connection(f"max_page_count = {pages}"), refused("the disk is full; free some space"):
        for _ in range(20):
            store.add(entry(calibration()), provenance())
    records, parameters = counts(store)
    assert parameters == 6 * records
    store.add(entry(calibration()), provenance())
    assert counts(store) == [records + 1, parameters + 6]


def test_a_full_disk_while_the_store_is_made_leaves_a_store_that_can_be_made(tmp_path):
    with every_connection("max_page_count = 3"), refused("the disk is full"):
        Store(tmp_path)
    assert Store(tmp_path).find() == ()


def test_a_read_only_store_can_be_read_but_not_written(store):
    with every_connection("query_only = ON"):
        assert len(Store.existing(store.folder).find()) == 1
        with refused("the store is not writable; check the rights"):
            store.add(entry(calibration()), provenance())
    assert counts(store) == [1, 6]


def test_a_store_locked_by_another_program_is_said_to_be_locked(store):
    with closing(sqlite3.connect(store.path, isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        with refused("another program keeps the store locked"):
            store.add(entry(calibration()), provenance())
        with refused("another program keeps the store locked"):
            store.find()
    assert counts(store) == [1, 6]


def test_a_store_can_be_read_while_another_program_writes(store):
    with closing(sqlite3.connect(store.path, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        assert len(store.find()) == 1


def test_a_file_that_is_no_database_is_refused_and_left_alone(tmp_path):
    (tmp_path / DATABASE).write_bytes(b"angle_deg,voltage_V\n" * 100)
    with refused("this is not a database"):
        Store(tmp_path)
    assert (tmp_path / DATABASE).read_bytes() == b"angle_deg,voltage_V\n" * 100


def test_a_database_of_another_program_is_refused_and_left_alone(tmp_path):
    with closing(sqlite3.connect(tmp_path / DATABASE)) as connection:
        connection.execute("CREATE TABLE addresses (name TEXT)")
    with refused("this database holds something else"):
        Store(tmp_path)
    with closing(sqlite3.connect(tmp_path / DATABASE)) as connection:
        assert connection.execute("SELECT name FROM sqlite_master").fetchall() == [("addresses",)]


def test_a_store_of_a_newer_version_is_refused(store):
    with closing(sqlite3.connect(store.path)) as connection, connection:
        connection.execute("UPDATE store SET version = 4")
    with refused(r"a newer version of the program made this store \(version 4, known up to 3\); update the program"):
        Store(store.folder)


def test_a_damaged_database_is_refused(store):
    content = bytearray(store.path.read_bytes())
    content[100:4096] = b"\xff" * 3996
    store.path.write_bytes(content)
    with refused("the database is damaged; restore it from a backup"):
        store.find()


def test_json_that_is_damaged_inside_a_sound_database_is_refused(store):
    with closing(sqlite3.connect(store.path)) as connection, connection:
        connection.execute("DROP TRIGGER records_no_update")
        connection.execute("UPDATE records SET result = '{'")
    with refused("a record is damaged"):
        store.find()


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "store").write_text("")
    with refused("check the folder of the store"):
        Store(tmp_path / "store")


def test_a_database_that_is_a_folder_is_refused(tmp_path):
    (tmp_path / DATABASE).mkdir()
    with refused("the file cannot be opened"):
        Store(tmp_path)


def test_an_error_that_nobody_foresaw_is_told_in_the_words_of_the_database(store):
    with closing(sqlite3.connect(store.path)) as connection, connection:
        connection.execute("DROP TABLE parameters")
    with refused(r"the database refused \(no such table: parameters\)"):
        store.add(entry(calibration()), provenance())


def test_opening_to_read_makes_no_store(tmp_path):
    with refused("there is no records.sqlite in this folder"):
        Store.existing(tmp_path / "mistyped")
    assert not (tmp_path / "mistyped").exists()


def test_an_empty_file_is_no_store_and_stays_as_it_is(tmp_path):
    (tmp_path / DATABASE).touch()
    with refused("this file is empty and no store; restore it from a backup, or remove it"):
        Store(tmp_path)
    assert (tmp_path / DATABASE).read_bytes() == b""


def test_a_database_without_tables_is_no_store(tmp_path):
    with closing(sqlite3.connect(tmp_path / DATABASE)) as connection:
        connection.execute("PRAGMA user_version = 7")
        connection.commit()
    with refused("this database holds something else"):
        Store(tmp_path)


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
def test_a_pipe_is_no_store(tmp_path):
    os.mkfifo(tmp_path / DATABASE)
    with refused("this is no file but a device or a pipe"):
        Store(tmp_path)


def test_two_that_make_one_store_at_once_have_the_same(tmp_path, monkeypatch):
    give_name = database._name
    others = []

    def slower(file, name):
        monkeypatch.setattr(database, "_name", give_name)
        others.append(Store(tmp_path))
        others[0].add(entry(calibration()), provenance())
        give_name(file, name)

    monkeypatch.setattr(database, "_name", slower)
    store = Store(tmp_path)

    assert len(store.find()) == len(others[0].find()) == 1
    assert [path.name for path in tmp_path.iterdir()] == [DATABASE]
