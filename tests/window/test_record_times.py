"""When records were measured, as a list of them shows it, sorts by it and looks for it."""

import time
from datetime import UTC, datetime

import pytest
from PySide6.QtCore import QDate, QLocale
from records_examples import provenance
from test_records_any_method import pendulum

from tumble.calibrations.records.store import Store
from tumble.window.widgets.record_search import RecordSearch
from tumble.window.widgets.record_table import RecordTable
from tumble.window.work.record_lines import lines_of


@pytest.fixture
def record_at(qapp, tmp_path):
    """Makes a record of a unit that is called as the moment when it was measured."""
    store = Store(tmp_path)
    return lambda moment: store.add(pendulum(), provenance(serial_number=moment, measured_at=moment))


@pytest.fixture
def desktop_in(monkeypatch):
    """Has the desktop in a time zone."""
    before = QLocale()

    def stay(zone):
        monkeypatch.setenv("TZ", zone)
        time.tzset()

    yield stay
    QLocale.setDefault(before)
    monkeypatch.undo()
    time.tzset()


@pytest.fixture
def in_kyiv(desktop_in):
    """Two hours ahead of UTC in winter."""
    desktop_in("Europe/Kyiv")


def test_a_list_tells_the_time_of_the_desktop(record_at, in_kyiv):
    QLocale.setDefault(QLocale("de_DE"))
    (line,) = lines_of([record_at("2026-11-27T23:30:00+00:00")], {})
    assert "28.11.26 01:30" in line.cells


def test_a_list_is_sorted_by_time_however_a_moment_is_written(record_at, qtbot):
    moments = [f"{day}T10:00:00+00:00" for day in ("2026-11-05", "2026-02-27", "2025-12-31")]
    table = RecordTable()
    qtbot.addWidget(table)
    table.show_lines(lines_of([record_at(moment) for moment in moments], {}))
    assert [row[0] for row in table.texts()] == moments


def test_a_day_that_is_looked_for_is_one_of_the_desktop(in_kyiv, qtbot):
    search = RecordSearch()
    qtbot.addWidget(search)
    search.since.setDate(QDate(2026, 11, 28))
    assert search.wanted().since == datetime(2026, 11, 27, 22, 0, tzinfo=UTC)


def test_a_day_lasts_to_the_end_of_an_hour_that_comes_twice(desktop_in, qtbot):
    desktop_in("America/Santiago")  # 24:00 becomes 23:00 on 4 April 2026, from UTC-3 to UTC-4 (tz database)
    search = RecordSearch()
    qtbot.addWidget(search)
    search.until.setDate(QDate(2026, 4, 4))
    assert search.wanted().until == datetime(2026, 4, 5, 3, 59, 59, 999999, tzinfo=UTC)


def test_a_day_begins_after_an_hour_that_does_not_come(desktop_in, qtbot):
    desktop_in("America/Santiago")  # 24:00 becomes 1:00 on 5 September 2026, from UTC-4 to UTC-3 (tz database)
    search = RecordSearch()
    qtbot.addWidget(search)
    search.since.setDate(QDate(2026, 9, 6))
    assert search.wanted().since == datetime(2026, 9, 6, 4, 0, tzinfo=UTC)


def test_the_last_moment_of_a_day_is_shown_on_that_day(record_at, in_kyiv):
    QLocale.setDefault(QLocale("de_DE"))
    (line,) = lines_of([record_at("2026-11-27T21:59:59.700000+00:00")], {})
    assert "27.11.26 23:59" in line.cells
