"""A window whose store another one has open as well: it shows what that one does, and leaves it alone."""

import pytest
from PySide6.QtCore import Qt
from two_windows import entry, stages

from tumble.window.work.queue_file import QueueFile
from tumble.window.work.run_queue import Stage


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def test_the_window_shows_what_another_one_adds_and_measures_it(driver, tiny, tmp_path, no_report):
    driver.window.stand.simulation.imagined.setChecked(True)
    other = QueueFile(tmp_path / "store")
    theirs = entry("X-9", programme=tiny)
    other.update(lambda queue: queue.add(theirs))
    driver.wait(lambda: [each.serial_number for each in driver.run.queue.queue.entries] == ["X-9"], 10)
    driver.window.open(driver.run)
    driver.press(Qt.Key.Key_F4)
    driver.wait(lambda: other.look() or stages(other)[0][1] is Stage.JUDGED)
    driver.wait(lambda: (other.look(), stages(other)[0][1] is Stage.JUDGED)[1])


def test_the_window_leaves_alone_what_another_one_measures(driver, tiny, tmp_path):
    other = QueueFile(tmp_path / "store")
    theirs = entry("X-9", programme=tiny)
    other.update(lambda queue: queue.add(theirs))
    other.claim("")
    driver.wait(lambda: [each.stage for each in driver.run.queue.queue.entries] == [Stage.MEASURING], 10)
    driver.window.open(driver.run)
    driver.run.queue.start()
    driver.run.queue.proceed()
    assert driver.run.queue_view.said.text() == "Everything in the queue was measured."
    assert not driver.window.busy
    other.leave()
    driver.wait(lambda: [each.stage for each in driver.run.queue.queue.entries] == [Stage.STOPPED], 10)
