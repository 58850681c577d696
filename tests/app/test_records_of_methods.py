"""The commands on records of every method, and on a chain from which one was taken."""

import math
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from app_jobs import tumble

from tumble.app.analysing import fit, trace
from tumble.app.calibrating import store as store_result
from tumble.app.identity import program_identity
from tumble.app.joining import read_together
from tumble.app.recall import open_store, verify_record
from tumble.calibrations.core.provenance import Provenance, Source
from tumble.calibrations.methods.head_reference.entry import entry as head_entry
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.observations import read_head_table
from tumble.calibrations.methods.temperature.entry import entry as temperature_entry
from tumble.calibrations.methods.temperature.loop import close_temperature_loop
from tumble.calibrations.methods.temperature.table import read_runs
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.records.raw import file_sha256
from tumble.calibrations.records.store import Store

HEAD = Path(__file__).parents[1] / "calibrations" / "fixtures" / "store_0_1" / "tables" / "head.csv"
SCALE_BY_TEMPERATURE = "temperature_degC,kx_V_per_g\n" + "".join(
    f"{temperature},{1.0 + 1e-4 * temperature + 1e-6 * (run % 3 - 1)}\n"
    for run, temperature in enumerate([-40, -20, 0, 20, 40, 60, 60, 40, 20, 0, -20, -40])
)


def origin(*paths):
    program = program_identity()
    return Provenance(
        serial_number="SN 5",
        stand={},
        sources=tuple(Source(kind="table", path=str(path), sha256=file_sha256(path)) for path in paths),
        program_version=program.version,
        packages=program.packages,
    )


def pendulum(**changed):
    period = {"value": 2.007, "standard_uncertainty": 0.001, "unit": "s"}
    content = {"method": "pendulum", "method_version": 1, "result": {}, "parameters": {"period": period}}
    return Entry(**content | changed)


def test_a_head_held_against_a_reference_is_a_record(tmp_path):
    record = Store(tmp_path).add(head_entry(close_reference_loop(read_head_table(HEAD))), origin(HEAD))
    assert (record.method, record.model) == ("head_reference", "augmented")
    assert tumble("records", "verify", "--store", tmp_path).status == 0
    shown = tumble("records", "show", record.id, "--store", tmp_path).out
    assert "method     head_reference, version 1" in shown
    assert "head_eccentricity" in shown


def test_parameters_against_temperature_are_a_record(tmp_path, write):
    table = write("runs.csv", SCALE_BY_TEMPERATURE)
    record = Store(tmp_path / "s").add(temperature_entry(close_temperature_loop(read_runs(table))), origin(table))
    assert record.method == "temperature"
    assert all(name.startswith("kx_V_per_g, ") for name in record.parameters)
    assert tumble("records", "verify", "--store", tmp_path / "s").status == 0


@pytest.fixture
def joint(tmp_path, write):
    """A record of two tables of one unit."""
    rows = [(angle, 2.5 - math.sin(math.radians(angle)) + 1e-4 * (angle % 7 - 3)) for angle in range(0, 360, 15)]
    first, second = (
        write(
            f"{name}.csv",
            "angle_deg,voltage_V\n" + "".join(f"{angle},{voltage + more}\n" for angle, voltage in rows),
        )
        for name, more in (("first", 0.0), ("second, again", 1e-5))
    )
    folder = tmp_path / "s"
    traced = trace(fit(read_together([first, second]), "SN 5", trials=0, folder=folder))
    return first, second, folder, store_result(traced, folder)


def test_a_joint_result_is_a_record_with_all_its_sources(joint):
    first, second, folder, record = joint
    assert [source.path for source in record.provenance.sources] == [str(first), str(second)]
    assert tumble("records", "verify", "--store", folder).status == 0


def test_each_file_of_a_joint_result_is_verified(joint):
    _, second, folder, record = joint
    second.write_text("angle_deg,voltage_V\n0,2.5\n", encoding="utf-8")
    said = tumble("records", "verify", "--store", folder)
    assert said.status == 2
    assert f"Raw file {second}: changed." in verify_record(open_store(folder), record).sentences


def test_a_joint_result_analysed_again_supersedes_the_first(joint):
    first, second, folder, record = joint
    again = store_result(trace(fit(read_together([first, second]), "SN 5", trials=0, folder=folder)), folder)
    assert (again.revision, again.supersedes) == (2, record.id)


def test_a_record_of_an_unknown_method_is_listed_shown_and_exported(tmp_path):
    record = Store(tmp_path).add(pendulum(), origin(HEAD))
    assert "pendulum" in tumble("records", "list", "--store", tmp_path).out
    assert "period 2.0070(10) s" in tumble("records", "show", record.id, "--store", tmp_path).out
    assert '"method": "pendulum"' in tumble("records", "export", record.id, "--store", tmp_path).out


def test_a_record_of_an_unknown_method_is_not_said_to_be_verified(tmp_path):
    Store(tmp_path).add(pendulum(), origin(HEAD))
    said = tumble("records", "verify", "--store", tmp_path)
    assert said.status == 2
    assert "This program cannot carry out the method pendulum; update it." in said.out


def test_the_report_of_a_record_of_another_method_is_refused_in_a_sentence(tmp_path):
    record = Store(tmp_path).add(pendulum(), origin(HEAD))
    said = tumble("report", record.id, "--store", tmp_path)
    assert (said.status, said.err.count("\n")) == (2, 1)


def test_records_of_different_methods_are_not_compared(tmp_path):
    store = Store(tmp_path)
    first, second = store.add(pendulum(), origin(HEAD)), store.add(pendulum(method="other"), origin(HEAD))
    said = tumble("records", "compare", first.id, second.id, "--store", tmp_path)
    assert said.status == 2
    assert "compare records of one method" in said.err


@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_record_deleted_past_the_triggers_is_noticed(tmp_path, number):
    for _ in range(3):
        Store(tmp_path).add(pendulum(), origin(HEAD))
    with closing(sqlite3.connect(tmp_path / "records.sqlite")) as connection, connection:
        for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
            connection.execute(f"DROP TRIGGER {name}")
        gone = f"(SELECT id FROM records WHERE sequence = {number})"
        connection.execute(f"DELETE FROM parameters WHERE record_id IN {gone}")
        connection.execute(f"DELETE FROM records WHERE sequence = {number}")
    said = tumble("records", "verify", "--store", tmp_path)
    assert said.status == 2
    assert f"Record {number} of 3 is missing from the chain of " in said.out


def test_a_whole_chain_says_its_last_hash(tmp_path):
    record = Store(tmp_path).add(head_entry(close_reference_loop(read_head_table(HEAD))), origin(HEAD))
    said = tumble("records", "verify", "--store", tmp_path).out
    assert f"the last, number 1, is {record.content_sha256[:16]}." in said


def test_a_superseded_record_that_was_altered_is_noticed(tmp_path):
    store = Store(tmp_path)
    first = store.add(pendulum(), origin(HEAD))
    store.add(pendulum(), origin(HEAD), supersedes=first.id)
    with closing(sqlite3.connect(tmp_path / "records.sqlite")) as connection, connection:
        connection.execute("DROP TRIGGER records_no_update")
        connection.execute("UPDATE records SET operator = 'somebody else' WHERE revision = 1")
    said = tumble("records", "verify", "--store", tmp_path).out
    assert f"{first.id}: NOT VERIFIED\n  Altered in the store: column operator; restore" in said


def test_every_raw_file_is_named_as_a_source(tmp_path, write):
    table = write("t.csv", "1\n")
    record = Store(tmp_path / "s").add(pendulum(), origin(HEAD, table))
    shown = tumble("records", "show", record.id, "--store", tmp_path / "s").out.splitlines()
    assert [line.split()[2] for line in shown if line.startswith("raw file ")] == [str(HEAD), str(table)]
