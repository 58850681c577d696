"""What is recorded cannot be changed, by any program, and can be read for good."""

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from records_examples import calibration, provenance
from sqlalchemy import create_mock_engine

from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.database import open_database
from tumble.calibrations.records.export import document, is_intact
from tumble.calibrations.records.schema import METADATA
from tumble.calibrations.records.store import DATABASE, Store

FIXTURE = Path(__file__).parent / "fixtures" / "records_v1.sqlite"


@pytest.fixture
def database(tmp_path):
    store = Store(tmp_path)
    first = store.add(entry(calibration()), provenance())
    store.add(entry(calibration()), provenance(), supersedes=first.id)
    with closing(sqlite3.connect(store.path)) as connection:
        yield connection


@pytest.mark.parametrize(
    "statement",
    [
        "UPDATE records SET operator = 'somebody else'",
        "DELETE FROM records",
        "UPDATE parameters SET value = 1.0 WHERE name = 'kx'",
        "DELETE FROM parameters",
        "INSERT OR REPLACE INTO records SELECT * FROM records",
        "INSERT OR REPLACE INTO parameters SELECT * FROM parameters",
    ],
)
def test_a_change_by_another_program_is_refused(database, statement):
    before = list(database.iterdump())
    with pytest.raises(sqlite3.IntegrityError, match="calibration records are immutable: add a revision instead"):
        database.execute(statement)
    assert list(database.iterdump()) == before


def test_a_second_revision_of_the_same_record_cannot_push_out_the_first(database):
    columns = [row[1] for row in database.execute("PRAGMA table_info(records)")]
    selected = ", ".join("'another'" if name == "id" else name for name in columns)
    with pytest.raises(sqlite3.IntegrityError, match="immutable"):
        database.execute(f"INSERT OR REPLACE INTO records SELECT {selected} FROM records WHERE revision = 2")


@pytest.mark.parametrize(
    ("pragma", "value"),
    [("foreign_keys", 1), ("synchronous", 2), ("journal_mode", "delete")],  # 2: FULL, see the SQLite documentation
)
def test_a_commit_is_on_the_disk_and_references_are_checked(tmp_path, pragma, value):
    with open_database(tmp_path / DATABASE, 1.0).connect() as connection:
        assert connection.exec_driver_sql(f"PRAGMA {pragma}").scalar() == value


def postgresql_ddl():
    statements = []
    engine = create_mock_engine(
        "postgresql://", lambda ddl, *_: statements.append(str(ddl.compile(dialect=engine.dialect)))
    )
    METADATA.create_all(engine, checkfirst=False)
    return "\n".join(statements)


def test_the_tables_are_made_by_postgresql_too():
    ddl = postgresql_ddl()
    assert "result JSON NOT NULL" in ddl
    assert "value DOUBLE PRECISION" in ddl
    assert "FOREIGN KEY(supersedes) REFERENCES records (id)" in ddl


def test_postgresql_gets_triggers_of_its_own():
    ddl = postgresql_ddl()
    assert "RAISE EXCEPTION 'calibration records are immutable" in ddl
    for table in ("records", "parameters"):
        assert f"BEFORE UPDATE OR DELETE ON {table} FOR EACH ROW EXECUTE FUNCTION refuse_change()" in ddl
        assert f"BEFORE TRUNCATE ON {table} FOR EACH STATEMENT EXECUTE FUNCTION refuse_change()" in ddl
    assert "RAISE(ABORT" not in ddl


@pytest.fixture
def store_v1(tmp_path):
    """A copy of the store that version 0.1.0 wrote; `records_examples` made it."""
    (tmp_path / DATABASE).write_bytes(FIXTURE.read_bytes())
    return Store.existing(tmp_path)


def test_records_of_format_1_still_load(store_v1):
    (second,) = store_v1.find(serial_number="SN 17")
    first, _ = store_v1.revisions(second)
    assert (first.format_version, first.revision, first.verdict.outcome) == (1, 1, Outcome.FAIL)
    assert first.provenance.operator == "Олена"
    assert first.parameters["u0"].value == pytest.approx(2.5, abs=1e-4)
    assert second.parameters["kz"].value is None


def test_the_hash_of_a_record_of_format_1_still_holds(store_v1):
    for record in store_v1.revisions(store_v1.find()[0]):
        assert is_intact(document(record))


def test_a_store_of_format_1_takes_new_records(store_v1):
    old = store_v1.find()[0]
    assert store_v1.add(entry(calibration()), provenance(), supersedes=old.id).revision == 3
