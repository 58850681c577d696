"""The commands on a store that version 0.1 made: everything is read as it lies, and migrated once."""

import json
import shutil
from pathlib import Path

import pytest
from app_jobs import tumble

OLD = Path(__file__).parents[1] / "calibrations" / "fixtures" / "store_0_1"
RECORD = "20261127-063159-bee188"


@pytest.fixture
def old(tmp_path):
    return Path(shutil.copytree(OLD, tmp_path / "old"))


def records(store, verb, *arguments):
    return tumble("records", verb, *arguments, "--store", store)


def test_the_records_of_an_old_store_are_listed_with_their_method(old):
    before = (old / "records.sqlite").read_bytes()
    lines = records(old, "list").out.splitlines()
    (row,) = [number for number, line in enumerate(lines) if RECORD in line]
    assert "SN 17" in lines[row]
    assert any("dividing_head" in line for line in lines[row + 1 :])
    assert (old / "records.sqlite").read_bytes() == before


def test_a_record_of_an_old_store_is_shown(old):
    shown = records(old, "show", RECORD).out.splitlines()
    assert "method     dividing_head, version 1" in shown
    assert "raw file   recordings/SN_17-bc48fa9e/20261127T063157Z-quick.mcap 04d7dc6b9192" in shown
    assert [line.split()[0] for line in shown[-6:]] == ["u0", "kx", "ky", "kz", "kxy", "alpha0"]


def test_a_record_of_an_old_store_is_exported_in_its_own_format(old):
    exported = json.loads(records(old, "export", RECORD).out)
    assert exported["schema"] == "tumble.record/3"
    assert exported["provenance"]["raw_path"] == "recordings/SN_17-bc48fa9e/20261127T063157Z-quick.mcap"


def test_an_old_store_is_verified_migrated_and_verified_again(old):
    for _ in range(2):
        verified = records(old, "verify")
        assert verified.status == 0
        assert f"{RECORD}: verified" in verified.out
        assert "1 of 1 record agrees with its raw files" in verified.out
        records(old, "migrate")
    assert tumble("stand", "verify", "--store", old).status == 0


def test_a_migration_says_where_the_old_database_is_kept(old):
    said = records(old, "migrate")
    assert said.status == 0
    assert said.out.splitlines() == [
        f"{old / 'records.sqlite'}: migrated",
        f"the database as it was is kept in {old / 'records.sqlite.version-1'}",
    ]
    assert records(old, "migrate").out == f"{old / 'records.sqlite'} is of this version: nothing was done\n"


def test_a_migration_of_no_store_is_bad_input(tmp_path):
    assert records(tmp_path, "migrate").status == 2
