import json
import shutil
from pathlib import Path
from threading import Event

import pytest
from PySide6.QtCore import QDate, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot
from window_driver import TINY

from tumble.calibrations.core.quantities import format_in_unit
from tumble.calibrations.records.store import Store
from tumble.window.screens.exporting import FORMATS
from tumble.window.widgets.dialog import FileDialog
from tumble.window.work import records as store


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
    driver.dismiss_all()
    search.serial.clear()
    search.verdict.setCurrentIndex(0)
    search.until.setDate(search.until.minimumDate())
    records.said.clear()
    records.table.sortByColumn(2, Qt.SortOrder.DescendingOrder)
    driver.window.open(records)
    records.refresh()
    driver.wait(lambda: not (driver.window.background.is_busy or records.surveyor.is_busy))
    driver.wait(lambda: records.trend.records == records.records)
    records.table.clearSelection()
    assert units(driver) == ["B-2", "A-1"]
    return driver


def units(driver):
    return [row[0] for row in driver.window.records.table.texts()]


def test_records_are_searched_by_serial_number_verdict_and_day(measured):
    search = measured.window.records.search
    search.serial.setText("b")
    measured.wait(lambda: units(measured) == ["B-2"])
    search.serial.clear()
    measured.wait(lambda: units(measured) == ["B-2", "A-1"])
    search.verdict.setCurrentIndex(search.verdict.findText("outside"))
    measured.wait(lambda: units(measured) == [])
    search.verdict.setCurrentIndex(0)
    search.until.setDate(QDate(2020, 1, 1))
    measured.wait(lambda: units(measured) == [])


def test_no_more_are_listed_than_can_be_looked_at(measured, monkeypatch):
    monkeypatch.setattr("tumble.window.work.records.SHOWN", 1)
    records = measured.window.records
    records.refresh()
    measured.wait(lambda: units(measured) == ["B-2"])
    assert records.more.text() == "The newest 1 are listed; look for fewer to see others."
    assert records.more.isVisible()
    records.search.serial.setText("A")
    measured.wait(lambda: units(measured) == ["A-1"])
    assert not records.more.isVisible()


def test_a_record_is_opened(measured):
    measured.window.records.table.selectRow(0)
    measured.window.records.open_button.click()
    presentation = measured.wait_for_result()
    assert presentation.concluded.traced.provenance.serial_number == "B-2"
    assert measured.window.result.isVisible()


def test_two_records_are_compared(measured):
    records = measured.window.records
    records.table.selectAll()
    records.compare_button.click()
    measured.wait(lambda: records.tabs.currentWidget() is records.comparison)
    assert "They are of two units: A-1, B-2." in records.said.text()
    texts = records.comparison.texts()[0]
    assert (texts[0], texts[6][:15]) == ("u0", "Not significant")
    assert [records.comparison.horizontalHeaderItem(column).text()[:5] for column in (1, 2)] == ["● A-1", "■ B-2"]


def test_the_record_that_is_chosen_is_shown_in_short(measured):
    records = measured.window.records
    records.table.selectRow(0)
    measured.wait(lambda: records.preview.shown is not None)
    assert records.preview.unit.text() == "B-2"
    assert records.preview.values.texts()[0][0] == "u0"
    assert records.preview.stand.text() == "Stand:\n  simulated: a simulated stand"
    records.table.selectAll()
    assert records.preview.unit.text() == "Choose a record to see it in short."


def test_a_record_that_is_chosen_no_more_is_not_shown_in_short(measured, monkeypatch):
    preview, put_off = store.preview, Event()

    def late(record):
        put_off.wait(5)
        return preview(record)

    monkeypatch.setattr(store, "preview", late)
    records = measured.window.records
    records.preview.show_nothing()
    records.table.selectRow(0)
    records.table.clearSelection()
    put_off.set()
    measured.wait(lambda: not measured.window.background.is_busy)
    assert records.preview.shown is None


def test_a_preview_stands_beside_the_list_where_there_is_room_and_is_a_tab_where_there_is_none(measured):
    window, records = measured.window, measured.window.records
    window.resize(1280, 800)
    measured.wait(lambda: records.tabs.indexOf(records.preview) >= 0)
    window.resize(1920, 1080)
    measured.wait(lambda: records.tabs.indexOf(records.preview) < 0)
    assert records.preview.isVisible()
    window.resize(1280, 800)
    measured.wait(lambda: records.tabs.indexOf(records.preview) >= 0)


def test_what_is_chosen_stays_chosen_wherever_its_row_goes(measured):
    records = measured.window.records
    records.table.selectRow(1)
    records.table.sortByColumn(0, Qt.SortOrder.AscendingOrder)
    records.refresh()
    with measured.bot.waitSignal(records.shown, timeout=60_000):
        pass
    assert [record.provenance.serial_number for record in records._chosen()] == ["A-1"]


def test_of_two_that_are_chosen_the_one_that_is_still_found_stays(measured):
    records = measured.window.records
    records.table.selectAll()
    records.search.serial.setText("b")
    measured.wait(lambda: units(measured) == ["B-2"])
    assert [record.provenance.serial_number for record in records._chosen()] == ["B-2"]
    measured.wait(lambda: records.preview.unit.text() == "B-2")


def test_a_sign_says_in_words_what_it_is(measured):
    table = measured.window.records.table
    said = [table.item(0, column).data(Qt.ItemDataRole.AccessibleTextRole) for column in (3, 5, 6)]
    assert said == ["not judged", "no effect was found", "simulated: a simulated stand"]
    assert not any(table.item(0, column).icon().isNull() for column in (3, 5, 6))


def test_a_record_is_verified_and_an_altered_raw_file_is_not(measured, tmp_path):
    records = measured.window.records
    records.table.selectRow(1)
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
    records.table.selectRow(1)
    records.export_to(path)
    measured.wait(lambda: records.said.text() == f"Written: {path}")
    assert path.read_bytes().startswith(begins)
    if suffix == "json":
        assert json.loads(path.read_text("utf-8"))["provenance"]["serial_number"] == "A-1"


def test_a_file_is_called_after_unit_and_record(measured):
    records = measured.window.records
    records.table.selectRow(0)
    records.export_button.click()
    (dialog,) = measured.window.dialogs.findChildren(QFileDialog)
    assert Path(dialog.selectedFiles()[0]).name == f"B-2-{records.table.chosen_records[0].id}.pdf"
    measured.dismiss_all()


def test_a_file_name_without_a_format_is_told(measured, tmp_path):
    records = measured.window.records
    records.table.selectRow(0)
    records.export_to(tmp_path / "out.docx")
    measured.wait(lambda: bool(measured.complaints))
    assert ".docx is no format of a record; end it in .json, .html, .csv or .pdf" in measured.complaints[0]


def test_a_trend_is_drawn_over_units_and_over_time(measured):
    trend = measured.window.records.trend
    trend.parameter.setCurrentText("u0")
    for over in range(2):
        trend.over.setCurrentIndex(over)
        assert trend.drawn == 2


def test_a_heading_sorts_and_rows_stay_the_records_that_they_are(measured):
    records = measured.window.records
    records.table.sortByColumn(0, Qt.SortOrder.AscendingOrder)
    assert units(measured) == ["A-1", "B-2"]
    records.table.selectRow(1)
    assert [record.provenance.serial_number for record in records._chosen()] == ["B-2"]


def test_enter_opens_the_record_that_is_chosen(measured):
    records = measured.window.records
    records.table.setCurrentCell(1, 0)
    measured.press(Qt.Key.Key_Return, at=records.table)
    assert measured.wait_for_result().concluded.traced.provenance.serial_number == "A-1"


def test_a_row_is_copied_whole(measured):
    table = measured.window.records.table
    table.selectRow(1)
    measured.window.activateWindow()
    measured.wait(measured.window.isActiveWindow)
    table.setFocus()
    measured.press(Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier, at=table)
    assert QGuiApplication.clipboard().text().split("\t")[:2] == ["A-1", "tiny"]


@pytest.mark.parametrize("ending", ["JSON (*.json)", "HTML (*.html)", "CSV (*.csv)", "PDF (*.pdf)"])
def test_an_export_takes_the_ending_of_the_format_that_is_chosen(measured, tmp_path, ending):
    suffix = ending.split("*")[1].rstrip(")")
    dialog = FileDialog("Export", tmp_path / "20261127-1.json", FORMATS, saving=True)
    measured.bot.addWidget(dialog)
    dialog.files.selectNameFilter(ending)
    dialog.files.filterSelected.emit(ending)
    assert [Path(name).name for name in dialog.files.selectedFiles()] == [f"20261127-1{suffix}"]
    with measured.bot.waitSignal(dialog.chosen) as chosen:
        dialog.files.accept()
    assert chosen.args == [tmp_path / f"20261127-1{suffix}"]


def test_a_name_that_is_typed_without_an_ending_gets_one(measured, tmp_path):
    dialog = FileDialog("Export", tmp_path / "a.json", FORMATS, saving=True)
    measured.bot.addWidget(dialog)
    dialog.files.selectFile("of-today")
    with measured.bot.waitSignal(dialog.chosen) as chosen:
        dialog.files.accept()
    assert chosen.args == [tmp_path / "of-today.json"]


def exported(driver, path=None):
    """The file that is asked for, once the dialog was opened for the record that is chosen; answered with a path."""
    driver.window.records._choose_export()
    (dialog,) = driver.window.dialogs.open
    asked = Path(dialog.files.selectedFiles()[0])
    if path is not None:
        dialog.chosen.emit(path)
    dialog.dismiss()
    return asked


def test_a_record_goes_where_the_last_one_went_and_in_its_format(measured, tmp_path):
    records = measured.window.records
    records.table.selectRow(0)
    assert exported(measured, tmp_path / "first.html").suffix == ".pdf"
    measured.wait((tmp_path / "first.html").is_file)
    asked = exported(measured)
    assert (asked.parent, asked.suffix) == (tmp_path, ".html")


def test_an_ending_that_is_no_format_is_not_asked_for_again(measured, tmp_path):
    measured.window.records.table.selectRow(0)
    before = exported(measured)
    exported(measured, tmp_path / "first.docx")
    measured.wait(lambda: bool(measured.complaints))
    assert exported(measured).suffix == before.suffix
    measured.dismiss_all()


def test_the_first_step_of_a_day_is_today(measured):
    day = measured.window.records.search.until
    day.stepBy(1)
    assert day.date() == QDate.currentDate()


def test_values_in_a_column_have_one_unit():
    assert format_in_unit(0.79363, 0.0077, "V/g") == "0.7936(77) V/g"
    assert format_in_unit(1.01643, 0.00018, "V/g") == "1.01643(18) V/g"
    assert format_in_unit(2.5, None, "V") == "2.50000 V"
