"""A screen that becomes smaller keeps the whole window, and STOP with it."""

import pytest
from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QApplication


@pytest.fixture
def screen(driver):
    return driver.window.screen()


def stop_is_on(driver, screen):
    button = driver.window.stop_bar.button
    place = QRect(button.mapToGlobal(QPoint(0, 0)), button.size())
    return screen.availableGeometry().contains(place)


def test_a_window_that_is_larger_than_its_screen_has_become_is_made_smaller(driver, screen):
    driver.window.resize(screen.size() * 2)
    assert not stop_is_on(driver, screen)
    screen.availableGeometryChanged.emit(screen.availableGeometry())
    driver.wait(lambda: stop_is_on(driver, screen))


def test_a_window_beyond_the_edge_of_what_is_left_is_moved_there(driver, screen):
    driver.window.move(screen.size().width() - 50, screen.size().height() - 50)
    assert not stop_is_on(driver, screen)
    screen.availableGeometryChanged.emit(screen.availableGeometry())
    driver.wait(lambda: stop_is_on(driver, screen))


def test_a_window_that_has_room_stays_where_it_is(driver, screen):
    driver.window.resize(1000, 700)
    driver.window.move(40, 40)
    screen.availableGeometryChanged.emit(screen.availableGeometry())
    for _ in range(3):
        QApplication.processEvents()
    assert (driver.window.pos(), driver.window.size().width()) == (QPoint(40, 40), 1000)
