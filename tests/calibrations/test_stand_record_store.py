import sqlite3
from dataclasses import replace
from pathlib import Path
from shutil import copyfile

import numpy as np
import pytest
from records_examples import minutes_pass
from stand_examples import rows
from stand_record_examples import FOUND, IDENTITY, UNIT, VALID

from tumble.calibrations.methods.dividing_head.stand.validity import validity_of
from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.store import Store
from tumble.calibrations.stand_records.record import Status, Validity, document
from tumble.calibrations.stand_records.store import StandRecords


def added(store, status=Status.PROVISIONAL, identity=IDENTITY):
    return store.add(
        identity=identity,
        status=status,
        corrections=FOUND,
        contributions=[UNIT],
        agreement_p=None,
        validity=VALID,
        program_version="0.1.0",
    )


def test_versions_are_counted_for_each_stand(tmp_path):
    store = StandRecords(tmp_path, now=minutes_pass())
    first, second = added(store), added(store, Status.IN_FORCE)
    elsewhere = added(store, identity=replace(IDENTITY, head="zaber H-2"))

    assert [first.version, second.version, elsewhere.version] == [1, 2, 1]
    assert [record.version for record in store.find(IDENTITY)] == [1, 2]


def test_a_record_comes_back_as_it_was(tmp_path):
    record = added(StandRecords(tmp_path))

    (again,) = StandRecords(tmp_path).find(stand="bench-1")

    assert document(again) == document(record)
    assert again.intact
    assert again.validity == VALID
    assert again.contributions == (UNIT,)


def test_the_newest_version_in_force_applies(tmp_path):
    store = StandRecords(tmp_path)
    assert store.in_force(IDENTITY) is None
    added(store)
    assert store.in_force(IDENTITY) is None
    added(store, Status.IN_FORCE)
    newest = added(store, Status.IN_FORCE)
    added(store)

    assert store.in_force(IDENTITY).id == newest.id
    assert store.in_force(replace(IDENTITY, daq="scpi D-2")) is None


def test_a_record_can_be_neither_changed_nor_deleted(tmp_path):
    store = StandRecords(tmp_path)
    added(store)
    connection = sqlite3.connect(store.path)

    for statement in ("UPDATE stand_records SET status = 'in force'", "DELETE FROM stand_records"):
        with pytest.raises(sqlite3.IntegrityError, match="immutable"):
            connection.execute(statement)
    connection.close()


def test_what_was_altered_all_the_same_is_seen(tmp_path):
    altered = replace(added(StandRecords(tmp_path)), status=Status.IN_FORCE)

    assert not altered.intact


@pytest.mark.parametrize("version", ["records_v1", "records_v2"])
def test_a_store_from_before_there_were_stand_records_takes_them(tmp_path, version):
    copyfile(Path(__file__).parent / "fixtures" / f"{version}.sqlite", tmp_path / "records.sqlite")
    if not StandRecords(tmp_path).find():
        added(StandRecords(tmp_path))

    assert len(StandRecords(tmp_path).find()) == 1
    assert len(Store(tmp_path).find()) == 1


def test_an_id_that_no_record_has_is_refused(tmp_path):
    with pytest.raises(RecordError, match="there is no stand record 2026; name the store that holds it"):
        StandRecords(tmp_path).get("2026")


def test_ranges_grow_with_what_was_measured():
    wider = VALID.together(Validity(angle_deg=(-90.0, 90.0), voltage_v=(1.0, 2.0), measured_from="2026-11-24T10:00"))

    assert (wider.angle_deg, wider.voltage_v, wider.temperature_degc) == ((-90.0, 345.0), (1.0, 3.6), (22.0, 24.0))
    assert (wider.measured_from, wider.measured_to) == ("2026-11-24T10:00", "2026-11-24T10:00")


def test_a_table_beyond_the_ranges_is_reported():
    table = replace(rows(), temperature_degc=np.full(288, 30.0))

    assert VALID.exceeded_by(validity_of(table)) == ["32 to 28 °C, known for 22 to 24 °C"]
    assert validity_of(table).together(VALID).exceeded_by(validity_of(table)) == []
