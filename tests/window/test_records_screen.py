import json
import shutil

import pytest
from PySide6.QtCore import QDate
from pytestqt.qtbot import QtBot
from window_driver import TINY

from tumble.calibrations.records.store import Store


@pytest.fixture(scope="module")
def two_records(request, shared_window, driver_of, tmp_path_factory):
    """A window, and its store with two units of which each has one record."""
    programme = tmp_path_factory.mktemp("programme") / "tiny.toml"
    programme.write_text(TINY, encoding="utf-8")
    shared_window.window.stand.simulation.speed.setCurrentIndex(0)
    driver = driver_of(QtBot(request), shared_window)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("tumble.calibrations.report.page.html", lambda _: "<html></html>")
        for serial in ("A-1", "B-2"):
            driver.start(programme, serial)
            driver.wait_for_result()
            driver.window.result.presentation = None
    return shared_window, shared_window.window.store


@pytest.fixture
def measured(qtbot, two_records, driver_of, tmp_path, no_report):
    """The window with a store of its own that holds those, nothing chosen and nothing looked for."""
    running, store = two_records
    shutil.copytree(store, tmp_path / "store")
    driver = driver_of(qtbot, running)
    records, search = driver.window.records, driver.window.records.search
    driver.window.store = tmp_path / "store"
    driver.window.result.presentation = None
    while driver.window.dialogs.close_newest():
        pass
    search.serial.clear()
    search.verdict.setCurrentIndex(0)
    search.until.setDate(search.until.minimumDate())
    records.said.clear()
    driver.window.open(records)
    records.refresh()
    driver.wait(lambda: not driver.window.background._under_way)
    records.table.clearSelection()
    assert units(driver) == ["A-1", "B-2"]
    return driver


def units(driver):
    return [row[0] for row in driver.window.records.table.texts()]


def test_records_are_searched_by_serial_number_verdict_and_day(measured):
    search = measured.window.records.search
    search.serial.setText("b")
    measured.wait(lambda: units(measured) == ["B-2"])
    search.serial.clear()
    measured.wait(lambda: units(measured) == ["A-1", "B-2"])
    search.verdict.setCurrentIndex(search.verdict.findText("outside"))
    measured.wait(lambda: units(measured) == [])
    search.verdict.setCurrentIndex(0)
    search.until.setDate(QDate(2020, 1, 1))
    measured.wait(lambda: units(measured) == [])


def test_a_record_is_opened(measured):
    measured.window.records.table.selectRow(1)
    measured.window.records.open_button.click()
    presentation = measured.wait_for_result()
    assert presentation.concluded.traced.provenance.serial_number == "B-2"
    assert measured.window.result.isVisible()


def test_two_records_are_compared(measured):
    records = measured.window.records
    records.table.selectAll()
    records.compare_button.click()
    measured.wait(lambda: "u0 changed by" in records.said.text())


def test_a_record_is_verified_and_an_altered_raw_file_is_not(measured, tmp_path):
    records = measured.window.records
    records.table.selectRow(0)
    records.verify_button.click()
    measured.wait(lambda: records.said.text().endswith("is verified."))
    (raw,) = (tmp_path / "store").glob("recordings/A-1/*.mcap")
    raw.write_bytes(raw.read_bytes() + b"x")
    records.verify_button.click()
    measured.wait(lambda: "does NOT verify" in records.said.text() and "changed" in records.said.text())


def test_an_analysis_done_again_is_a_further_revision(measured, tmp_path):
    measured.window.records.table.selectRow(0)
    measured.window.records.again_button.click()
    presentation = measured.wait_for_result()
    assert Store.existing(tmp_path / "store").get(presentation.concluded.record_id).revision == 2


@pytest.mark.parametrize(
    ("suffix", "begins"), [("json", b"{"), ("html", b"<html>"), ("csv", b"time_s,"), ("pdf", b"%PDF")]
)
def test_a_record_is_exported(measured, tmp_path, suffix, begins):
    records, path = measured.window.records, tmp_path / f"out.{suffix}"
    records.table.selectRow(0)
    records.export_to(path)
    measured.wait(lambda: records.said.text() == f"Written: {path}")
    assert path.read_bytes().startswith(begins)
    if suffix == "json":
        assert json.loads(path.read_text("utf-8"))["provenance"]["serial_number"] == "A-1"


def test_a_file_name_without_a_format_is_told(measured, tmp_path):
    records = measured.window.records
    records.table.selectRow(0)
    records.export_to(tmp_path / "out.docx")
    measured.wait(lambda: bool(measured.complaints))
    assert ".docx is no format; end it in .json, .html, .csv or .pdf" in measured.complaints[0]


def test_a_trend_is_drawn_over_units_and_over_time(measured):
    trend = measured.window.records.trend
    trend.parameter.setCurrentText("u0")
    for over in range(2):
        trend.over.setCurrentIndex(over)
        assert trend.drawn == 2
