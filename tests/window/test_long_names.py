"""A unit whose name is as long as one may be leaves room for everything else."""

import pytest
from PySide6.QtCore import Qt
from records_examples import calibration, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.store import Store

LONG_NAME = "SN-" + "0" * 96 + "7"


@pytest.fixture
def driver(lent_driver):
    """A window as wide as a small screen."""
    lent_driver.window.resize(1264, 760)
    return lent_driver


def in_sight(table, column):
    left = table.columnViewportPosition(column)
    return 0 <= left < table.viewport().width()


def test_the_state_of_a_run_is_in_sight_beside_a_long_name(driver, tiny):
    driver.open_run(tiny, LONG_NAME)
    driver.press(Qt.Key.Key_F2)
    table = driver.run.queue_view.table
    driver.wait(lambda: in_sight(table, 5), 5)
    assert table.texts()[0][0] == LONG_NAME


def test_a_verdict_is_in_sight_beside_a_long_name(driver, tmp_path):
    Store(tmp_path / "store").add(entry(calibration()), provenance(serial_number=LONG_NAME))
    records = driver.window.records
    driver.window.open(records)
    records.refresh()
    driver.wait(lambda: records.table.rowCount() == 1)
    driver.wait(lambda: in_sight(records.table, 3), 5)


def test_the_strip_tells_a_long_name_by_its_ends(driver, tiny):
    driver.open_run(tiny, LONG_NAME)
    strip = driver.window.strip
    assert strip.names.text().endswith("0 … 0000000007")
    assert strip.names.toolTip().endswith(LONG_NAME)
    assert strip.state.width() > 2 * strip.names.width()


def test_a_trend_tells_a_long_name_by_its_ends(driver, tmp_path):
    Store(tmp_path / "store").add(entry(calibration()), provenance(serial_number=LONG_NAME))
    driver.window.records.refresh()
    driver.wait(lambda: driver.window.records.trend.drawn == 1)
    assert driver.window.records.trend.key.endswith("0 … 0000000007")
