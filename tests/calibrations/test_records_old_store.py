"""A store that version 0.1 of the program made is read as it is, migrated once, and loses nothing."""

import shutil
import sqlite3
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import pytest
from records_examples import calibration, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.errors import StoreError
from tumble.calibrations.records.export import document, is_intact
from tumble.calibrations.records.migrations import running
from tumble.calibrations.records.schema import STORE_VERSION
from tumble.calibrations.records.store import DATABASE, Store
from tumble.calibrations.records.verify import verify
from tumble.calibrations.records.wanted import Wanted
from tumble.calibrations.stand_records.store import StandRecords

FIXTURES = Path(__file__).parent / "fixtures"
OLD = FIXTURES / "store_0_1"
RECORD = "20261127-063159-bee188"
STAND_RECORD = "20261127-063540-2464d7"


@pytest.fixture
def folder(tmp_path):
    return Path(shutil.copytree(OLD, tmp_path / "old"))


def bytes_in(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def dump(path):
    with closing(sqlite3.connect(path)) as connection:
        return list(connection.iterdump())


def schema(path):
    """Columns, keys, indexes and triggers of every table."""
    with closing(sqlite3.connect(path)) as connection:
        names = [name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        columns = {name: set(connection.execute(f"SELECT name, pk FROM pragma_table_info('{name}')")) for name in names}
        others = set(connection.execute("SELECT type, name FROM sqlite_master WHERE type IN ('index', 'trigger')"))
    return columns, {(kind, name) for kind, name in others if not name.startswith("sqlite_")}


def test_an_old_store_is_read_and_not_one_byte_of_it_changes(folder):
    before = bytes_in(folder)
    store = Store.existing(folder)
    (record,) = store.find(serial_number="SN 17", method="dividing_head")
    assert (record.id, record.method, record.method_version, record.link) == (RECORD, "dividing_head", 1, None)
    assert [(source.kind, source.path) for source in record.provenance.sources] == [
        ("recording", "recordings/SN_17-bc48fa9e/20261127T063157Z-quick.mcap")
    ]
    assert store.raw_files(record)[0].is_file()
    assert list(record.values) == ["u0", "kx", "ky", "kz", "kxy", "alpha0"]
    assert store.inventory().removed == store.inventory().chains == ()
    assert [record.id for record in StandRecords(folder).find()] == [STAND_RECORD]
    assert bytes_in(folder) == before


def test_an_old_store_is_read_where_nothing_can_be_written(folder):
    database = folder / DATABASE
    database.chmod(0o444)
    folder.chmod(0o555)
    try:
        assert Store.existing(folder).get(RECORD).id == RECORD
    finally:
        folder.chmod(0o755)


def test_a_record_of_an_old_store_is_intact_before_and_after_the_migration(folder):
    store = Store.existing(folder)
    before = store.get(RECORD)
    refit = None
    assert is_intact(document(before))
    assert verify(before, store, refit, "0.2.0").altered == ()
    store.migrate()
    after = Store.existing(folder).get(RECORD)
    assert after == before
    assert document(after) == document(before)
    assert verify(after, store, refit, "0.2.0").altered == ()


@pytest.mark.parametrize("fixture", [f"records_v{number}.sqlite" for number in (1, 2, 3, 4)])
def test_records_of_every_older_format_go_through_the_migration(tmp_path, fixture):
    shutil.copy(FIXTURES / fixture, tmp_path / DATABASE)
    store = Store.existing(tmp_path)
    before = store.revisions(store.find()[0])
    copy = store.migrate()
    after = store.revisions(store.find()[0])
    assert after == before
    assert [verify(record, store, None, "0.2.0").altered for record in after] == [(), ()]
    assert dump(copy) == dump(FIXTURES / fixture)


def test_parameters_with_a_given_alpha0_keep_it(tmp_path):
    shutil.copy(FIXTURES / "records_v1.sqlite", tmp_path / DATABASE)
    store = Store.existing(tmp_path)
    (record,) = store.find()
    seen = store.rows(record)[1]
    store.migrate()
    assert store.rows(record)[1] == seen
    assert [row["given"] for row in seen if row["given"]] == [
        {given.name: given.value for given in parameter.given}
        for parameter in record.parameters.values()
        if parameter.given
    ]


def test_a_migrated_store_has_the_tables_and_triggers_of_a_new_one(folder, tmp_path):
    Store.existing(folder).migrate()
    assert schema(folder / DATABASE) == schema(Store(tmp_path / "new").path)


def test_a_deletion_before_the_migration_still_leaves_its_gap(folder):
    store = Store.existing(folder)
    with closing(sqlite3.connect(store.path)) as connection, connection:
        connection.execute("DROP TRIGGER records_no_update")
        connection.execute("UPDATE records SET rowid = 3")
    assert store.inventory().numbers_without_record == 2
    store.migrate()
    assert store.inventory().numbers_without_record == 2


def test_the_first_record_added_migrates_the_store_and_keeps_a_copy_of_it(folder):
    before = dump(folder / DATABASE)
    store = Store(folder)
    added = store.add(entry(calibration()), provenance())
    assert [record.id for record in store.find()] == [added.id, RECORD]
    assert dump(folder / f"{DATABASE}.version-1") == before


def test_a_first_stand_record_migrates_the_store_too(folder):
    known = StandRecords(folder)
    (old,) = known.find()
    known.add(
        identity=old.identity,
        status=old.status,
        corrections=old.corrections,
        contributions=old.contributions,
        agreement_p=None,
        validity=old.validity,
        program_version="0.2.0",
    )
    assert (folder / f"{DATABASE}.version-1").exists()
    assert [record.version for record in known.find()] == [1, 2]
    assert known.find()[0].content_sha256 == old.content_sha256


def test_a_second_migration_does_nothing(folder):
    store = Store(folder)
    assert store.migrate() == folder / f"{DATABASE}.version-1"
    assert store.migrate() is None


def test_an_old_record_is_superseded_by_a_new_one(folder):
    store = Store(folder)
    old = store.get(RECORD)
    new = store.add(entry(calibration()), provenance(sources=old.provenance.sources), supersedes=RECORD)
    assert (new.revision, new.supersedes) == (2, RECORD)
    assert store.revisions(new)[0] == old


def test_a_migration_that_fails_leaves_the_store_as_it_was(folder, monkeypatch):
    before = dump(folder / DATABASE)
    monkeypatch.setattr(running, "update", no_room)
    with pytest.raises(StoreError, match="No space left"):
        Store(folder).migrate()
    monkeypatch.undo()
    assert dump(folder / DATABASE) == before
    assert Store(folder).migrate()


def no_room(*_):
    raise OSError(28, "No space left on device")


KILLED = """
import os, sys
from pathlib import Path
from tumble.calibrations.records.migrations import running
from tumble.calibrations.records.store import Store
running.update = lambda *_: os._exit(9)
Store(Path(sys.argv[1])).migrate()
"""


def test_a_migration_that_is_killed_leaves_the_store_as_it_was(folder):
    before = dump(folder / DATABASE)
    assert subprocess.run([sys.executable, "-c", KILLED, folder], check=False).returncode == 9
    assert dump(folder / DATABASE) == before
    assert Store.existing(folder).get(RECORD).id == RECORD


def test_two_that_open_an_old_store_at_once_migrate_it_once(folder):
    def add(number):
        return Store(folder).add(entry(calibration()), provenance(serial_number=f"SN {number}"))

    with ThreadPoolExecutor(4) as pool:
        added = list(pool.map(add, range(4)))
    assert {record.id for record in Store(folder).find()} == {RECORD, *(record.id for record in added)}
    assert [chain.faults for chain in Store(folder).inventory().chains] == [()]


def test_a_store_that_another_has_migrated_meanwhile_is_read(folder):
    opened = Store.existing(folder)
    assert opened.get(RECORD).id == RECORD
    Store(folder).migrate()
    assert opened.get(RECORD).id == RECORD


def test_there_is_a_script_for_every_version():
    scripts = {path.stem for path in Path(running.__file__).parent.glob("versions/version_*.py")}
    assert scripts == {f"version_{number}" for number in range(1, STORE_VERSION + 1)}


def test_what_was_found_is_searched_for_before_and_after_the_migration(tmp_path):
    shutil.copy(FIXTURES / "records_v4.sqlite", tmp_path / DATABASE)
    store = Store.existing(tmp_path)
    (record,) = store.newest(Wanted(finding="k_xx"), 10)
    assert store.newest(Wanted(finding=""), 10) == ()
    assert store.findings() == ()
    assert store.migrate() == tmp_path / f"{DATABASE}.version-2"
    assert store.newest(Wanted(finding="k_xx"), 10) == (record,)
    assert store.findings() == ("k_xx",)


def test_a_record_of_before_there_were_lots_says_none_in_its_document(tmp_path):
    shutil.copy(FIXTURES / "records_v4.sqlite", tmp_path / DATABASE)
    (record,) = Store.existing(tmp_path).find()
    assert document(record)["schema"] == "tumble.record/4"
    assert "lot" not in document(record)["provenance"]
    assert record.provenance.lot == ""


@pytest.mark.parametrize("content", ["{", "[1]", "null", '{"effects": "k_xx"}', "[" * 100_000])
@pytest.mark.parametrize("fixture", ["records_v1.sqlite", "records_v4.sqlite"])
def test_a_damaged_record_is_migrated_as_it_is(tmp_path, fixture, content):
    shutil.copy(FIXTURES / fixture, tmp_path / DATABASE)
    with closing(sqlite3.connect(tmp_path / DATABASE)) as connection:
        connection.execute("DROP TRIGGER records_no_update")
        connection.execute("UPDATE records SET result = ?", (content,))
        connection.commit()
    store = Store.existing(tmp_path)
    store.migrate()
    with closing(sqlite3.connect(tmp_path / DATABASE)) as connection:
        assert connection.execute("SELECT DISTINCT result FROM records").fetchall() == [(content,)]
    assert store.newest(Wanted(finding="k_xx"), 10) == ()
