import pytest
from PySide6.QtCore import Qt

from tumble.calibrations.records.store import Store


@pytest.fixture(scope="module", autouse=True)
def figures():
    """They are drawn here."""


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def test_seed_from_serial_number_to_stored_record(driver, tmp_path):
    driver.open_run("seed")
    assert driver.run.form.summary.text().startswith("430 points, 11 mountings")
    driver.press(Qt.Key.Key_F5)

    presentation = driver.wait_for_result()

    (record,) = Store.existing(tmp_path / "store").find(serial_number="SN-1")
    assert len(driver.run.view.points) == 430
    assert driver.run.view.overview.done == 430
    assert presentation.concluded.record_id == record.id
    assert driver.window.result.table.texts()[1][:2] == ["kx", "scale factor"]
    assert driver.window.result.table.texts()[1][2].endswith("V/g")
    assert presentation.concluded.report.is_file()
    assert "The run is over: the programme was carried out." in driver.log


def test_a_person_confirms_every_mount_shown_by_a_picture(driver, write, no_report):
    driver.start(write("two.toml", TWO_MOUNTS), imagined=False)
    for mount in ("face-up", "edge"):
        driver.wait(lambda mount=mount: driver.run.view.asks and driver.run.view.prompt.value == mount)
        driver.press(Qt.Key.Key_F9)
    driver.wait_for_result()
    assert driver.log.count("The unit sits in the mount") == 2


def test_a_scan_never_starts_motion(driver, write):
    driver.start(write("two.toml", TWO_MOUNTS), imagined=False)
    driver.wait(lambda: driver.run.view.asks)
    for target in (
        driver.window,
        driver.run.form.serial,
        driver.run.controls.start,
        driver.run.view.prompt.confirm,
    ):
        driver.scan("SN 2 yes face-up", at=target)
    driver.bot.wait(100)
    assert driver.run.view.asks
    assert driver.run.view.points == []


def test_a_scan_fills_in_the_serial_number_and_the_next_one_takes_its_place(driver):
    driver.open_run("quick", serial="A-1")
    driver.scan("B-2")
    assert driver.run.form.serial.text() == "B-2"
    assert not driver.window.busy


def test_a_run_leaves_what_the_command_line_leaves(driver, tiny, tmp_path, no_report):
    driver.start(tiny)
    presentation = driver.wait_for_result()
    (recording,) = (tmp_path / "store").glob("recordings/SN-1/*.mcap")
    assert presentation.concluded.recordings == (recording,)
    record = Store.existing(tmp_path / "store").get(presentation.concluded.record_id)
    assert record.result["rows"] == {"read": 6, "used": 6, "set_aside": []}


TWO_MOUNTS = """\
name = "two"
dwell_s = 0.1

[[procedure]]
kind = "sweep"
step_deg = 30.0
points = 12

[[procedure]]
kind = "sweep"
mount = "edge"
step_deg = 30.0
points = 12
"""
