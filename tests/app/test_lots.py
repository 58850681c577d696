"""The lot of a unit, from recordings that say it, say nothing or contradict each other, to the record."""

from itertools import count

import pytest
from app_jobs import TINY, tumble

from tumble.app.analysing import fit
from tumble.app.recall import recall
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
