"""Tables that were measured elsewhere, from their file to the record."""

from pathlib import Path

import pytest

from tumble.calibrations.records.store import Store
from tumble.window.generic.section_list import SectionList
from tumble.window.widgets.table import Table

HEAD = Path(__file__).parents[2] / "docs" / "samples" / "head.csv"


@pytest.fixture
def analysed(lent_driver):
    """A window that was given a table of a head against a reference."""
    lent_driver.window.records.analyse_file(HEAD)
    lent_driver.wait_for_result()
    return lent_driver


def test_a_table_leaves_a_record_with_its_report(analysed, tmp_path):
    (record,) = Store.existing(tmp_path / "store").find(serial_number="head")
    shown = analysed.window.result.presentation.concluded
    assert (record.method, record.id) == ("head_reference", shown.record_id)
    assert shown.report.read_text("utf-8").rstrip().endswith("</html>")
    assert analysed.window.frame.current is analysed.window.result
    assert analysed.window.result.table.texts()[0][::2][:2] == ["offset", "(-0.18 ± 0.22) °"]
    assert analysed.window.result.findChildren(SectionList)


def test_the_record_of_a_table_is_opened_verified_and_exported(analysed, tmp_path):
    window = analysed.window
    records, before = window.records, window.result.presentation
    analysed.wait(lambda: len(records.records) == 1)
    records.table.selectRow(0)
    records.open_button.click()
    analysed.wait(lambda: window.result.presentation is not before or analysed.complaints)
    assert not analysed.complaints
    assert window.result.presentation.table == before.table
    records.verify_button.click()
    analysed.wait(lambda: "is verified" in records.said.text() or "NOT" in records.said.text())
    assert "is verified" in records.said.text()
    records.export_to(tmp_path / "head.html")
    analysed.wait(lambda: "Written" in records.said.text())
    assert "head" in (tmp_path / "head.html").read_text("utf-8")


def test_a_table_that_is_analysed_again_gets_a_further_revision(analysed, tmp_path):
    records = analysed.window.records
    analysed.wait(lambda: len(records.records) == 1)
    records.table.selectRow(0)
    records.again_button.click()
    analysed.wait(lambda: [record.revision for record in records.records] == [2] or analysed.complaints)
    assert not analysed.complaints


def test_a_file_that_is_no_table_is_refused_in_a_sentence(lent_driver, write):
    lent_driver.window.records.analyse_file(write("empty.csv", ""))
    lent_driver.wait(lambda: lent_driver.complaints)
    assert "empty.csv" in lent_driver.complaints[0]


def test_the_last_column_that_is_shown_fills_the_table(qtbot):
    table = Table(("first", "last", "hidden"))
    qtbot.addWidget(table)
    table.resize(500, 300)
    table.show()
    table.fill([["a", "b", "c"]])
    table.setColumnHidden(2, True)
    table.resize(100, 300)
    qtbot.waitUntil(lambda: not table.horizontalHeader().stretchLastSection())
    table.resize(600, 300)
    qtbot.waitUntil(lambda: table.columnWidth(0) + table.columnWidth(1) == table.viewport().width())


def test_the_last_column_wraps_where_it_has_room_and_is_scrolled_to_where_not(qtbot):
    table = Table(("first", "last"))
    qtbot.addWidget(table)
    table.resize(500, 300)
    table.show()
    table.fill([["a few words", "what it means, in so many words that they have no room beside the first ones at all"]])
    qtbot.waitUntil(lambda: table.rowHeight(0) > 1.5 * table.fontMetrics().height())
    assert not table.horizontalScrollBar().maximum()
    table.resize(150, 300)
    qtbot.waitUntil(lambda: table.columnWidth(1) > 500)
    assert table.horizontalScrollBar().maximum()


def test_the_last_column_wraps_again_once_it_has_room_again(qtbot):
    table = Table(("first", "last"))
    qtbot.addWidget(table)
    table.fill([("x" * 30, "one word after the other " * 10)])
    table.resize(150, 200)
    table.show()
    qtbot.waitUntil(lambda: not table.horizontalHeader().stretchLastSection())
    table.resize(900, 200)
    qtbot.waitUntil(table.horizontalHeader().stretchLastSection)
    qtbot.waitUntil(lambda: table.horizontalScrollBar().maximum() == 0)
    assert table.columnWidth(0) + table.columnWidth(1) <= table.viewport().width()
