"""A stand file is changed outside while its stand is on screen: no run goes by what it said before."""

import pytest
from PySide6.QtCore import Qt
from window_driver import STAND

from tumble.window.work.run_queue import Stage


@pytest.fixture
def stand(driver, write):
    """The file of a stand that is connected, changed since."""
    path = write("bench.toml", STAND)
    driver.window.stand.open(path)
    driver.window.stand.connect_button.click()
    driver.wait(lambda: driver.window.worker.session.is_connected and not driver.window.worker.busy)
    write("bench.toml", STAND.replace("760.0", "10.0"))
    return path


def changed(path):
    return f"{path}: was changed since it was read; read it again before anything moves"


def test_no_run_begins_by_limits_of_the_past(driver, stand, tiny):
    driver.open_run(tiny)
    driver.press(Qt.Key.Key_F5)
    assert driver.complaints == [changed(stand)]
    assert not driver.window.busy


def test_it_is_read_again_by_the_key_of_the_notice(driver, stand, tiny):
    driver.open_run(tiny)
    driver.press(Qt.Key.Key_F5)
    driver.press(Qt.Key.Key_F11)
    driver.wait(lambda: driver.window.stand.loaded.file.positioners["head"].limits_deg == (-180.0, 10.0))
    assert driver.complaints == []


def test_a_queue_waits_until_it_was_read_again(driver, stand, tiny, write):
    write("bench.toml", STAND)
    driver.open_run(tiny, "A-1")
    driver.press(Qt.Key.Key_F2)
    write("bench.toml", STAND.replace("760.0", "750.0"))
    driver.press(Qt.Key.Key_F4)
    driver.wait(lambda: driver.complaints == [changed(stand)])
    assert [entry.stage for entry in driver.run.queue.queue.entries] == [Stage.WAITING]
    assert not driver.run.queue.going


def test_no_stand_is_reached_by_what_its_file_said_before(driver, write):
    path = write("bench.toml", STAND)
    driver.window.stand.open(path)
    write("bench.toml", STAND.replace("760.0", "10.0"))
    driver.window.stand.connect_button.click()
    driver.wait(lambda: driver.complaints == [changed(path)])
    assert not driver.window.worker.session.is_connected
