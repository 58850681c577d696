"""The database of a store is deleted while its window is open."""

import pytest
from PySide6.QtCore import Qt


@pytest.fixture
def driver(driver, tiny, no_report):
    """A window with a record whose database was deleted."""
    driver.start(tiny)
    driver.wait_for_result()
    driver.wait(lambda: len(driver.window.records.records) == 1)
    (driver.window.store / "records.sqlite").unlink()
    return driver


def test_records_that_are_gone_are_told(driver):
    driver.window.open(driver.window.records)
    driver.window.records.refresh()
    driver.wait(lambda: any("this database is gone" in said for said in driver.complaints))


def test_no_run_begins_other_records_in_their_place(driver):
    driver.window.open(driver.run)
    driver.press(Qt.Key.Key_F5)
    driver.wait(lambda: any("nothing was measured" in said for said in driver.complaints))
    assert not (driver.window.store / "records.sqlite").exists()


def test_a_run_whose_store_is_lost_meanwhile_is_kept_and_offered(driver, tiny, monkeypatch):
    path = driver.window.store / "records.sqlite"
    monkeypatch.setattr("tumble.app.calibrating.make_ready", lambda _: None)  # it was there when the run began
    driver.start(tiny, "B-2")
    driver.wait(lambda: any("the recording is kept in" in said for said in driver.complaints))
    assert not path.exists()
    assert list((driver.window.store / "recordings" / "B-2").glob("*.mcap"))
