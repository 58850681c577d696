import ast
import re
from contextlib import suppress

import pytest
from dialogs_of_the_window import DIALOGS, OVER_THE_SCREENS, POPUPS, ROOT, SOURCES
from PySide6.QtCore import QPoint, QSettings, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.exceptions import TimeoutError as WaitedTooLong
from window_driver import STAND

from tumble.messages import Language
from tumble.window.preferences import SCALES
from tumble.window.stop_guard import STOP_KEYS
from tumble.window.widgets.dialog import Dialog

MODAL = re.compile(r"Modal|WindowModality|\bexec\b")
A_WINDOW_OF_ITS_OWN = re.compile(r"Q\w*Dialog|QMessageBox|QMenu|QWizard|\w*Dialogs?")


@pytest.fixture(scope="module")
def connected(shared_window, tmp_path_factory):
    """One window for all tests here, its stand connected and slow enough to be seen turning."""
    path = tmp_path_factory.mktemp("stand") / "other.toml"
    path.write_text(STAND.replace("bench-1", "other"), encoding="utf-8")
    shared_window.window.stand.simulation.speed.setCurrentIndex(2)
    return shared_window, path


@pytest.fixture
def moving(qtbot, connected, driver_of):
    """The head on its way to where nothing stops it in time but STOP; opens something first."""
    shared, path = connected
    driver = driver_of(qtbot, shared)
    window = driver.window
    window.open(window.stand)
    if window.stand.connect_button.isEnabled():
        window.stand.connect_button.click()
    driver.wait(window.stand.jog.isEnabled)

    def opened():
        over = window.notices.cards or window.finder.isVisible()
        return window.dialogs.open or over or QApplication.activePopupWidget()

    def begin(open_it, *arguments):
        open_it(driver, *arguments)
        with suppress(WaitedTooLong):  # a screen that is only coming up may close a menu
            driver.wait(opened, 5)
        if not opened():
            open_it(driver, *arguments)
        driver.wait(opened)
        window.worker.move_to("head", -170.0 if head_deg(driver) > 300.0 else 750.0)
        driver.wait(lambda: window.worker.busy)
        return driver

    yield begin, path
    while popup := QApplication.activePopupWidget():
        popup.close()
    driver.dismiss_all()
    driver.wait(lambda: not window.worker.busy)


def head_deg(driver):
    return driver.window.stand.dials.of("head")._status.angle_deg


def press_stop(window):
    """A press of the mouse where STOP is on the screen, on whichever window of the application lies there."""
    button = window.stop_bar.button
    place = button.mapToGlobal(button.rect().center())
    under = QGuiApplication.topLevelAt(place)
    QTest.mouseClick(under, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, under.mapFromGlobal(place))


def assert_stops(driver):
    driver.wait(lambda: not driver.window.worker.busy, 3)
    assert -169.0 < head_deg(driver) < 749.0


@pytest.mark.parametrize("name", DIALOGS)
def test_stop_is_clicked_with_every_dialog_open(moving, name):
    begin, path = moving
    driver = begin(DIALOGS[name], path)
    assert driver.window.dialogs.open
    press_stop(driver.window)
    assert_stops(driver)
    assert driver.window.dialogs.open, "STOP is no answer to a question"


@pytest.mark.parametrize("name", OVER_THE_SCREENS)
def test_stop_is_clicked_with_whatever_lies_over_the_screens(moving, name):
    begin, path = moving
    driver = begin(OVER_THE_SCREENS[name], path)
    press_stop(driver.window)
    assert_stops(driver)


@pytest.mark.parametrize("name", POPUPS)
def test_stop_is_clicked_with_every_menu_and_list_open(moving, name):
    begin, _ = moving
    driver = begin(POPUPS[name])
    press_stop(driver.window)
    assert_stops(driver)


@pytest.mark.parametrize("name", [*DIALOGS, *OVER_THE_SCREENS, *POPUPS])
def test_the_stop_key_stops_whatever_has_the_keyboard(moving, name):
    begin, path = moving
    opened = DIALOGS | OVER_THE_SCREENS
    driver = begin(opened[name], path) if name in opened else begin(POPUPS[name])
    QTest.keyClick(driver.window.windowHandle(), Qt.Key.Key_F12)
    assert_stops(driver)


@pytest.mark.parametrize(
    ("key", "modifiers"),
    [
        (Qt.Key.Key_F12, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Pause, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Period, Qt.KeyboardModifier.ControlModifier),
    ],
)
def test_every_stop_key_stops_from_a_text_field(moving, key, modifiers):
    begin, _ = moving
    driver = begin(lambda driver: driver.window.open(driver.run) or driver.window.dialogs.show_dialog(Dialog("a", "b")))
    QTest.keyClick(driver.run.form.serial, key, modifiers)
    assert_stops(driver)
    assert driver.run.form.serial.text() == ""


def test_esc_closes_a_dialog_and_stops_nothing(moving):
    begin, path = moving
    driver = begin(DIALOGS["stand file"], path)
    QTest.keyClick(driver.window.windowHandle(), Qt.Key.Key_Escape)
    assert driver.window.dialogs.open == []
    assert driver.window.worker.busy
    QTest.keyClick(driver.window.windowHandle(), Qt.Key.Key_Escape)
    (said,) = driver.window.notices.cards
    assert said.notice.text == f"Esc stops nothing: it closes dialogs and notices. STOP is {STOP_KEYS[0]}."
    press_stop(driver.window)
    assert_stops(driver)


@pytest.mark.parametrize(
    ("language", "scale"),
    [
        (Language.ENGLISH, 1.0),
        (Language.ENGLISH, 2.0),
        (Language.UKRAINIAN, 1.0),
        (Language.UKRAINIAN, 2.0),
        (Language.UKRAINIAN, SCALES[-1]),
    ],
)
def test_stop_is_wholly_on_screen(driver_of, qtbot, shared_window, language, scale, connected):
    """At 1280 × 800 with a frame, on every screen and with every dialog open."""
    driver = driver_of(qtbot, shared_window)
    speak_and_dress(driver, language, scale)
    for screen in driver.window._in_order:
        driver.window.open(screen)
        assert_whole(driver.window)
    for open_it in (DIALOGS | OVER_THE_SCREENS).values():
        open_it(driver, connected[1])
        assert_whole(driver.window)
        driver.dismiss_all()


def speak_and_dress(driver, language, scale):
    if QSettings().value("look/language") != str(language):
        QSettings().setValue("look/language", str(language))
        before = driver.window
        driver.running._restart()
        driver.wait(lambda: driver.window is not before)
    QSettings().setValue("look/text_scale", scale)
    driver.window.dress_wanted.emit()


def assert_whole(window):
    QApplication.processEvents()
    button = window.stop_bar.button
    assert window.screen().availableGeometry().contains(window.frameGeometry())
    assert button.size() == button.sizeHint()
    corners = (button.rect().topLeft(), button.rect().bottomRight())
    for corner in (button.mapTo(window, corner) for corner in corners):
        assert window.rect().contains(corner)
        assert window.childAt(corner) is button


def test_every_dialog_of_the_package_is_known_here():
    """Whoever adds a dialog, a menu or anything modal adds it to `dialogs_of_the_window`, where STOP is pressed."""
    found = set()
    for path in ROOT.rglob("*.py"):
        tree = ast.parse(path.read_text("utf-8"))
        names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        named = {name for name in names if A_WINDOW_OF_ITS_OWN.fullmatch(name)}
        found |= {(path.relative_to(ROOT).as_posix(), name) for name in named}
    assert found == SOURCES


def test_nothing_is_modal():
    attributes = {
        (path.relative_to(ROOT).as_posix(), node.attr)
        for path in ROOT.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Attribute) and MODAL.search(node.attr)
    }
    assert attributes == {("start.py", "exec"), ("widgets/dialog.py", "setModal")}


def test_a_list_that_opens_over_stop_is_moved_off_it(moving):
    begin, _ = moving
    driver = begin(POPUPS["menu help"])
    button = driver.window.stop_bar.button
    popup = QApplication.activePopupWidget()
    popup.close()
    popup.popup(button.mapToGlobal(QPoint(5, 5)) - QPoint(0, popup.height() // 2))
    place = button.mapToGlobal(button.rect().center())
    assert not popup.geometry().contains(place)
    press_stop(driver.window)
    assert_stops(driver)
