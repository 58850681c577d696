"""Adding records to a store and finding them again."""

import re
import sqlite3
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest
from records_examples import (
    KX_INSIDE,
    KY_OUTSIDE,
    as_recorded,
    calibration,
    minutes_pass,
    provenance,
    raw_source,
    sweep_only,
)
from sqlalchemy.dialects import sqlite

from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.findings import UNNAMED
from tumble.calibrations.records.listing import newest
from tumble.calibrations.records.store import Store
from tumble.calibrations.records.wanted import Wanted


@pytest.fixture
def store(tmp_path):
    return Store(tmp_path / "store", now=minutes_pass())


def test_a_record_read_back_is_the_record_that_was_added(store):
    added = store.add(entry(calibration(), [KX_INSIDE, KY_OUTSIDE]), provenance())
    assert Store.existing(store.folder).get(added.id) == added


def test_a_record_gives_back_the_parameters_of_the_calibration(store):
    record = store.add(entry(calibration()), provenance())
    assert as_recorded(record.parameters) == as_recorded(calibration().parameters)


def test_the_parameters_of_a_record_keep_their_usual_order(store):
    record = Store.existing(store.folder).get(store.add(entry(calibration()), provenance()).id)
    assert list(record.parameters) == ["u0", "kx", "ky", "kz", "kxy", "alpha0"]


def test_a_parameter_without_value_keeps_its_reason(store):
    kz = store.get(store.add(entry(sweep_only()), provenance()).id).parameters["kz"]
    assert (kz.value, kz.degrees_of_freedom, kz.interval_95) == (None, None, None)
    assert kz.reason == sweep_only().parameters["kz"].reason != ""


def test_the_id_starts_with_the_time_of_recording_and_sorts_by_it(store):
    ids = [store.add(entry(calibration()), provenance()).id for _ in range(3)]
    assert re.fullmatch(r"20261122-141503-[0-9a-f]{6}", ids[0])
    assert ids == sorted(ids)


def test_a_record_is_found_by_an_unambiguous_beginning_of_its_id(store):
    first, _ = store.add(entry(calibration()), provenance()), store.add(entry(calibration()), provenance())
    assert store.get("20261122-1415") == first


def test_an_ambiguous_beginning_lists_what_it_fits(store):
    first, second = store.add(entry(calibration()), provenance()), store.add(entry(calibration()), provenance())
    with pytest.raises(RecordError, match=f"{first.id}, {second.id}"):
        store.get("20261122")


@pytest.mark.parametrize("prefix", ["2025", "%", "20261122_"])
def test_an_unknown_id_is_said_so(store, prefix):
    store.add(entry(calibration()), provenance())
    with pytest.raises(RecordError, match=f"no record has an id that begins with '{prefix}'"):
        store.get(prefix)


def test_a_revision_names_the_old_record_and_takes_its_place(store):
    first = store.add(entry(calibration()), provenance())
    second = store.add(entry(calibration()), provenance(program_version="0.2.0"), supersedes=first.id)
    assert (first.revision, second.revision, second.supersedes) == (1, 2, first.id)
    assert store.find() == (second,)
    assert store.revisions(second) == (first, second)
    assert store.get(first.id) == first


def test_analyses_of_one_file_at_the_same_time_supersede_each_other(store):
    with ThreadPoolExecutor(4) as pool:
        made = list(pool.map(lambda _: Store(store.folder).revise(entry(calibration()), provenance()), range(8)))

    (standing,) = store.find()
    assert sorted(record.revision for record in made) == [1, 2, 3, 4, 5, 6, 7, 8]
    assert [record.revision for record in store.revisions(standing)] == [1, 2, 3, 4, 5, 6, 7, 8]


@pytest.mark.parametrize("changed", [{"sources": (raw_source(sha256="00" * 32),)}, {"serial_number": "SN-8"}])
def test_an_analysis_of_another_file_or_unit_stands_beside(store, changed):
    first = store.revise(entry(calibration()), provenance())
    second = store.revise(entry(calibration()), provenance(**changed))

    assert (second.revision, second.supersedes) == (1, None)
    assert {record.id for record in store.find()} == {first.id, second.id}


@pytest.mark.parametrize(
    ("old", "changed", "message"),
    [
        ("nothing", {}, "there is no record nothing to supersede"),
        ("first", {}, "is superseded already; supersede"),
        ("second", {"sources": (raw_source(sha256="00" * 32),)}, "comes from another raw file"),
    ],
)
def test_a_revision_that_does_not_fit_is_refused_and_nothing_is_written(store, old, changed, message):
    first = store.add(entry(calibration()), provenance())
    second = store.add(entry(calibration()), provenance(), supersedes=first.id)
    ids = {"nothing": "nothing", "first": first.id, "second": second.id}
    with pytest.raises(RecordError, match=message):
        store.add(entry(calibration()), provenance(**changed), supersedes=ids[old])
    assert store.find() == (second,)


def test_records_are_found_by_unit_programme_and_verdict(store):
    inside = store.add(entry(calibration(), [KX_INSIDE]), provenance())
    outside = store.add(entry(calibration(), [KX_INSIDE, KY_OUTSIDE]), provenance(programme_name="quick"))
    other = store.add(entry(calibration()), provenance(serial_number="SN 18"))
    assert store.find(serial_number="SN 17") == (inside, outside)
    assert store.find(programme_name="quick") == (outside,)
    assert store.find(verdict=Outcome.PASS) == (inside,)
    assert store.find(verdict=Outcome.FAIL) == (outside,)
    assert store.find(verdict=Outcome.NO_LIMITS) == (other,)
    assert store.find(serial_number="SN 18", verdict=Outcome.PASS) == ()


def test_records_are_found_by_the_time_of_measurement_whatever_its_time_zone(store):
    later = store.add(entry(calibration()), provenance(measured_at="2026-11-20T11:00:00+02:00"))
    earlier = store.add(entry(calibration()), provenance(measured_at="2026-11-20T08:30:00Z"))
    assert store.find() == (earlier, later)
    nine = datetime(2026, 11, 20, 9, 0, tzinfo=UTC)
    assert store.find(since=nine) == (later,)
    assert store.find(until=nine) == (earlier, later)
    assert store.find(until=datetime(2026, 11, 20, 8, 59, tzinfo=UTC)) == (earlier,)


def test_a_time_without_zone_is_refused(store):
    with pytest.raises(ValueError, match="has no time zone"):
        store.find(since=datetime(2026, 11, 20))
    with pytest.raises(ValueError, match="has no time zone"):
        store.add(entry(calibration()), provenance(measured_at="2026-11-20T11:00:00"))


def test_the_latest_record_is_the_one_measured_last_or_else_recorded_last(store):
    store.add(entry(calibration()), provenance(measured_at="2026-11-21T00:00:00Z"))
    store.add(entry(calibration()), provenance(measured_at="2026-11-20T00:00:00Z"))
    undated = store.add(entry(calibration()), provenance(measured_at=""))
    assert store.latest("SN 17") == undated
    assert store.latest("SN 99") is None


def test_a_raw_file_inside_the_store_moves_with_it(store):
    raw = store.folder / "runs" / "raw.csv"
    stored = store.raw_path(raw)
    assert stored == "runs/raw.csv"
    assert store.raw_files(store.add(entry(calibration()), provenance(sources=(raw_source(stored),)))) == (raw,)


def test_a_raw_file_elsewhere_keeps_its_absolute_path(store, tmp_path):
    raw = tmp_path / "elsewhere.csv"
    stored = store.raw_path(raw)
    assert Path(stored) == raw.resolve()
    record = store.add(entry(calibration()), provenance(sources=(raw_source(stored),)))
    assert store.raw_files(record) == (raw.resolve(),)


def test_a_cut_measurement_is_marked_incomplete(store):
    whole = store.add(entry(calibration()), provenance())
    cut = store.add(
        entry(replace(calibration(), observations=replace(calibration().observations, complete=False))), provenance()
    )
    assert [record.complete for record in (whole, cut)] == [True, False]
    assert [store.rows(record)[0]["complete"] for record in (whole, cut)] == [True, False]


def test_writers_that_open_and_write_at_the_same_time_all_succeed(tmp_path):
    def write(number):
        return Store(tmp_path).add(entry(calibration()), provenance(serial_number=f"SN {number}"))

    with ThreadPoolExecutor(4) as pool:
        written = list(pool.map(write, range(12)))
    assert {record.id for record in Store(tmp_path).find()} == {record.id for record in written}
    assert len(written) == 12


@pytest.fixture
def several(store):
    """Records of three units, in the order in which they were measured."""
    return [store.add(entry(calibration()), provenance(serial_number=unit)) for unit in ("AB-1", "ÄB-2", "AC-3")]


@pytest.mark.parametrize(
    ("part", "units"),
    [("", ["AC-3", "ÄB-2", "AB-1"]), ("ab", ["AB-1"]), ("äb", ["ÄB-2"]), ("%", []), ("b-", ["ÄB-2", "AB-1"])],
)
def test_the_newest_are_found_by_a_part_of_their_serial_number(store, several, part, units):
    found = store.newest(Wanted(part_of_serial_number=part), 10)
    assert [record.provenance.serial_number for record in found] == units


def test_no_more_are_read_than_are_wanted(store, several):
    assert [record.id for record in store.newest(Wanted(), 2)] == [several[2].id, several[1].id]


def test_what_was_superseded_is_not_among_the_newest(store, several):
    store.add(entry(calibration()), provenance(serial_number="AB-1"), supersedes=several[0].id)
    assert several[0].id not in [record.id for record in store.newest(Wanted(), 10)]


@pytest.mark.parametrize(
    "sought",
    [
        Wanted(),
        Wanted(part_of_serial_number="b"),
        Wanted(part_of_serial_number="ä"),
        Wanted(stand_name="bench-1", method="triad"),
        Wanted(part_of_lot="b"),
        Wanted(part_of_lot="ä"),
        Wanted(finding="k_xx"),
        Wanted(finding=""),
    ],
)
def test_a_search_reads_no_table_but_an_index(store, several, sought):
    with sqlite3.connect(store.path) as database:
        database.create_function("folded", 1, str.casefold, deterministic=True)
        wanted = newest(sought, 3)
        query = str(wanted.compile(dialect=sqlite.dialect(), compile_kwargs={"literal_binds": True}))
        plan = " ".join(row[3] for row in database.execute(f"EXPLAIN QUERY PLAN {query}"))
    assert "USING COVERING INDEX ix_records_found" in plan
    assert "TEMP B-TREE" not in plan


def test_letters_that_sqlite_does_not_fold_are_folded_once_a_unit(store):
    for _ in range(3):
        store.add(entry(calibration()), provenance(serial_number="ÄB-2"))
    folded = []
    with sqlite3.connect(store.path) as database:
        database.create_function("folded", 1, lambda text: (folded.append(text), text.casefold())[1])
        wanted = newest(Wanted(part_of_serial_number="ä"), 10)
        query = str(wanted.compile(dialect=sqlite.dialect(), compile_kwargs={"literal_binds": True}))
        assert len(database.execute(query).fetchall()) == 3
    assert folded == ["ÄB-2"]


@pytest.mark.parametrize("earlier", ["ix_records_listing", "ix_records_search"])
def test_a_store_with_another_index_gets_this_one_with_the_next_record(store, several, earlier):
    with sqlite3.connect(store.path) as database:
        database.execute("DROP INDEX ix_records_found")
        database.execute(f"CREATE INDEX {earlier} ON records (created_at)")
    assert len(store.newest(Wanted(), 10)) == 3
    store.add(entry(calibration()), provenance())
    with sqlite3.connect(store.path) as database:
        names = {row[0] for row in database.execute("SELECT name FROM sqlite_master WHERE name LIKE 'ix_records_%'")}
    assert "ix_records_found" in names
    assert earlier not in names


def test_the_newest_are_found_by_stand_and_method(store):
    for stand, method in (("bench-1", "dividing_head"), ("bench-2", "dividing_head"), ("bench-2", "triad")):
        store.add(replace(entry(calibration()), method=method), provenance(stand_name=stand))
    found = store.newest(Wanted(stand_name="bench-2", method="triad"), 10)
    assert [(each.provenance.stand_name, each.method) for each in found] == [("bench-2", "triad")]
    assert len(store.newest(Wanted(stand_name="bench-2"), 10)) == 2
    assert len(store.newest(Wanted(method="dividing_head"), 10)) == 2
    assert store.stands() == ("bench-1", "bench-2")
    assert store.methods() == ("dividing_head", "triad")


@pytest.mark.parametrize(("part", "lots"), [("", ["", "Ä-1", "B-2"]), ("b", ["B-2"]), ("ä", ["Ä-1"]), ("%", [])])
def test_the_newest_are_found_by_a_part_of_their_lot(store, part, lots):
    for lot in ("B-2", "Ä-1", ""):
        store.add(entry(calibration()), provenance(lot=lot))
    assert [each.provenance.lot for each in store.newest(Wanted(part_of_lot=part), 10)] == lots


@pytest.mark.parametrize("spelt", ["Й", "\N{CYRILLIC CAPITAL LETTER I}\N{COMBINING BREVE}"])
@pytest.mark.parametrize("sought", ["й", "\N{CYRILLIC SMALL LETTER I}\N{COMBINING BREVE}"])
def test_a_letter_is_found_whether_it_is_one_character_or_two(store, spelt, sought):
    store.add(entry(calibration()), provenance(lot=f"{spelt}-26"))
    assert len(store.newest(Wanted(part_of_lot=f"{sought}-2"), 10)) == 1


def test_a_lot_that_was_taken_out_of_its_column_keeps_no_search_from_the_others(store):
    for lot in ("Ä-1", "Ä-2"):
        store.add(entry(calibration()), provenance(lot=lot))
    with sqlite3.connect(store.path) as database:
        database.execute("DROP TRIGGER records_no_update")
        database.execute("UPDATE records SET lot = NULL WHERE lot = 'Ä-1'")
    assert [each.provenance.lot for each in store.newest(Wanted(part_of_lot="ä"), 10)] == ["Ä-2"]


def test_all_of_a_lot_are_found_by_its_name(store):
    for lot in ("B-2", "B-21", ""):
        store.add(entry(calibration()), provenance(lot=lot))
    assert [each.provenance.lot for each in store.find(lot="B-2")] == ["B-2"]
    assert [each.provenance.lot for each in store.find(lot="")] == [""]


def with_effects(*names, unexplained=()):
    """A result in which a closed loop found so much."""
    recorded = entry(calibration())
    loop = {"effects": [{"name": name} for name in names], "unexplained": list(unexplained)}
    return replace(recorded, result={**recorded.result, "loop": {**loop, "declared": recorded.result}})


@pytest.mark.parametrize(
    ("finding", "units"),
    [
        (None, ["none", "unnamed", "two", "one"]),
        ("", ["none"]),
        ("k_xx", ["two", "one"]),
        ("k_x", []),
        ("hysteresis", ["two"]),
        (UNNAMED, ["unnamed"]),
    ],
)
def test_the_newest_are_found_by_what_was_found_in_them(store, finding, units):
    store.add(with_effects("k_xx"), provenance(serial_number="one"))
    store.add(with_effects("k_xx", "hysteresis", "k_xx"), provenance(serial_number="two"))
    store.add(with_effects(unexplained=[{}]), provenance(serial_number="unnamed"))
    store.add(with_effects(), provenance(serial_number="none"))
    assert [each.provenance.serial_number for each in store.newest(Wanted(finding=finding), 10)] == units
    assert store.findings() == ("hysteresis", "k_xx", UNNAMED)
