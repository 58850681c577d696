"""The lot of a unit, from recordings that say it, say nothing or contradict each other, to the record."""

from itertools import count

import pytest
from app_jobs import TINY, tumble
from records_examples import calibration, provenance, raw_source

from tumble.app.analysing import fit
from tumble.app.last_calibration import other_lots
from tumble.app.recall import recall
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.store import Store

TABLE = "angle_deg,voltage_V\n" + "".join(f"{angle},{angle % 7}\n" for angle in range(0, 360, 10))


@pytest.fixture
def measured(write, tmp_path):
    """Measures a unit that is said to be of a lot, and returns the recording."""
    programme, number = write("tiny.toml", TINY), count(1)

    def measure(lot):
        recording = tmp_path / f"{next(number)}.mcap"
        ran = tumble("run", "--programme", programme, "--serial", "SN-1", "--lot", lot, "--out", recording)
        assert ran.status == 0, ran.err
        return recording

    return measure


@pytest.fixture
def close_loop(tmp_path):
    """Closes the loop on files, and returns the run with the record."""

    def close(*files_and_options):
        ran = tumble("close-loop", *files_and_options, "--record", "--store", tmp_path / "store")
        assert ran.status == 0, ran.err
        return ran, Store.existing(tmp_path / "store").latest("SN-1")

    return close


def test_several_recordings_are_of_the_lot_that_one_of_them_says(measured, close_loop):
    ran, record = close_loop(measured(""), measured("L 2"))
    assert record.provenance.lot == "L 2"
    assert "lot" not in ran.err


def test_recordings_that_name_different_lots_are_told_of(measured, close_loop):
    first, second = measured("L 1"), measured("L 2")
    ran, record = close_loop(first, second)
    assert record.provenance.lot == "L 1"
    assert f"{second}: the unit is of lot L 2 here, but of lot L 1 in {first}; see which is right" in ran.err


def test_a_lot_that_is_given_with_files_takes_the_place_of_theirs(measured, close_loop):
    _, record = close_loop(measured("L 1"), "--lot", "L 2")
    assert record.provenance.lot == "L 2"


def test_a_lot_that_was_given_stays_where_the_record_is_analysed_again(measured, close_loop, tmp_path):
    _, record = close_loop(measured("L 1"), "--lot", "L 2")
    _, measurement = recall(tmp_path / "store", record.id)
    assert fit(measurement, trials=0).provenance.lot == "L 2"


@pytest.mark.parametrize("command", [("fit",), ("close-loop", "--record")])
def test_a_table_is_of_the_lot_that_is_given(write, tmp_path, command):
    table = write("t.csv", TABLE)
    ran = tumble(*command, table, "--serial", "SN-1", "--lot", "L 1", "--store", tmp_path / "store")
    assert ran.status == 0, ran.err
    assert Store.existing(tmp_path / "store").latest("SN-1").provenance.lot == "L 1"


def test_the_report_of_a_table_names_the_lot_that_is_given(write, tmp_path):
    table, page = write("t.csv", TABLE), tmp_path / "t.html"
    assert tumble("report", table, "--lot", "L 26/3", "--out", page).status == 0
    assert "L 26/3" in page.read_text("utf-8")


@pytest.fixture
def kept(tmp_path):
    """Keeps a unit as of a lot, measured on a day, and returns the record."""
    store, number = Store(tmp_path / "store"), count(1)

    def keep(unit, lot, day):
        source = raw_source(path=f"{next(number)}.csv", sha256=f"{day:064d}")
        stand = {"name": "simulated", "head": {"driver": "simulated"}}
        origin = provenance(
            serial_number=unit, lot=lot, stand=stand, sources=(source,), measured_at=f"2020-01-{day:02d}T10:00:00Z"
        )
        return store.add(entry(calibration()), origin)

    return keep


@pytest.mark.parametrize(
    ("earlier", "told"),
    [
        ([("SN-1", "L 1")], True),
        ([("SN-1", "L 1"), ("SN-1", "")], True),
        ([("SN-1", "L 1"), ("SN-1", "L 2")], False),
        ([("SN-1", "")], False),
        ([("SN-2", "L 1")], False),
    ],
)
def test_a_unit_of_which_the_last_record_names_another_lot_is_told_of(kept, tmp_path, earlier, told):
    first, *_ = [kept(unit, lot, day) for day, (unit, lot) in enumerate(earlier, 11)]
    said = (f"SN-1 is of lot L 2 here, but of lot L 1 in record {first.id}; see which is right",)
    assert other_lots(tmp_path / "store", kept("SN-1", "L 2", 21)) == (said if told else ())


def test_a_unit_without_a_lot_contradicts_none(kept, tmp_path):
    kept("SN-1", "L 1", 11)
    assert other_lots(tmp_path / "store", kept("SN-1", "", 12)) == ()


@pytest.mark.parametrize("command", ["calibrate", "close-loop"])
def test_who_gives_another_lot_at_the_stand_is_warned(kept, write, tmp_path, command):
    kept("SN-1", "L 1", 11)
    stand = ("--programme", write("tiny.toml", TINY), "--store", tmp_path / "store")
    ran = tumble(command, *stand, "--serial", "SN-1", "--lot", "L 2")
    assert ran.status == 0, ran.err
    assert "warning: SN-1 is of lot L 2 here, but of lot L 1 in record " in ran.err


@pytest.mark.parametrize("language", ["de", "uk"])
def test_unit_and_lot_are_shown_as_they_are_written_in_every_language(write, tmp_path, language):
    store = ("--store", tmp_path / "store")
    ran = tumble("fit", write("t.csv", TABLE), "--serial", "SN 1.5 V", "--lot", "L 26.3 to 50%", *store)
    assert ran.status == 0, ran.err
    record = Store.existing(tmp_path / "store").latest("SN 1.5 V")
    shown = tumble("--language", language, "records", "show", record.id, *store).out
    assert {line[11:] for line in shown.splitlines()} >= {"SN 1.5 V", "L 26.3 to 50%"}
