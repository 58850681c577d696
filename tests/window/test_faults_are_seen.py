"""No thread, timer or slot of the window dies unseen, and STOP works after each of them."""

import ast
import sys

import pytest
from dialogs_of_the_window import ROOT
from PySide6.QtCore import Qt, QTimer

from tumble.drivers.simulated.head import SimulatedHead
from tumble.procedures.events import WarningRaised

FAULT = "A fault of the program; the head was told to stop."


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def told(driver):
    return [card.notice.details for card in driver.window.notices.cards]


def still_works(driver):
    stand = driver.window.stand
    if not driver.window.worker.session.is_connected:
        driver.wait(stand.connect_button.isEnabled)
        stand.connect_button.click()
    driver.wait(stand.jog.isEnabled)
    driver.press(Qt.Key.Key_F12)
    driver.wait(lambda: not driver.window.busy)


@pytest.mark.parametrize("error", [SystemExit(3), KeyboardInterrupt(), MemoryError(), ZeroDivisionError("x")])
def test_whatever_a_driver_raises_is_shown_and_the_thread_of_the_stand_lives(driver, monkeypatch, tmp_path, error):
    def fail(_head):
        raise error

    monkeypatch.setattr(SimulatedHead, "identify", fail)
    driver.window.stand.connect_button.click()
    driver.wait(lambda: driver.complaints)
    assert driver.complaints == [FAULT]
    assert type(error).__name__ in told(driver)[0]
    monkeypatch.undo()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    still_works(driver)


def test_a_look_at_an_idle_head_that_fails_leaves_the_stand_and_says_why(driver, monkeypatch, tmp_path):
    still_works(driver)
    monkeypatch.setattr(SimulatedHead, "status", lambda _: 1 / 0)
    driver.wait(lambda: driver.complaints)
    assert "ZeroDivisionError" in told(driver)[0]
    assert driver.window.stand.cards.cards["head"].text("model") == "—"
    monkeypatch.undo()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    still_works(driver)


def test_a_display_that_cannot_count_goes_on_and_says_so(driver):
    driver.window.bridge._progress = lambda _event: 1 / 0
    for message in ("first", "second"):
        driver.window.bridge.listen(WarningRaised(message=message))
    driver.wait(lambda: driver.complaints)
    assert driver.complaints == [FAULT]


def test_an_exception_in_the_thread_of_the_analysis_is_shown(driver):
    driver.window.background.start(lambda: 1 / 0, lambda _: None)
    driver.wait(lambda: driver.complaints)
    still_works(driver)


@pytest.mark.parametrize("where", ["timer", "other thread", "destructor"])
def test_what_nobody_catches_is_shown_once_however_often_it_comes(driver, where, monkeypatch):
    for name in ("excepthook", "unraisablehook"):
        monkeypatch.setattr(sys, name, getattr(sys, name))
    monkeypatch.setattr("threading.excepthook", None)
    driver.running.catch_faults()
    for _ in range(3):
        {"timer": in_a_timer, "other thread": in_a_thread, "destructor": in_a_destructor}[where]()
    driver.wait(lambda: driver.complaints)
    driver.bot.wait(50)
    assert driver.complaints == [FAULT]
    monkeypatch.undo()


def in_a_timer():
    QTimer.singleShot(0, lambda: 1 / 0)


def in_a_thread():
    from threading import Thread

    thread = Thread(target=lambda: 1 / 0)
    thread.start()
    thread.join()


def in_a_destructor():
    class Bad:
        def __del__(self):
            raise ZeroDivisionError

    Bad()


def test_a_fault_of_showing_a_fault_does_not_go_round_in_circles(driver, monkeypatch, tmp_path):
    monkeypatch.setattr(driver.window, "tell", lambda error: driver.running._show_fault(error) or 1 / 0)
    with pytest.raises(ZeroDivisionError):
        driver.running._show_fault(ValueError("bent"))
    assert "bent" in (tmp_path / "state" / "tumble" / "window-faults.log").read_text("utf-8")


def test_every_thread_and_timer_is_known_here():
    """Whoever adds one makes its exceptions seen, and says so here."""
    kinds = {"Thread", "ThreadPoolExecutor", "QThread", "QThreadPool", "QRunnable", "QTimer", "Timer"}
    found = {
        (path.relative_to(ROOT).as_posix(), node.id)
        for path in ROOT.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Name) and node.id in kinds
    }
    assert found == {
        ("place.py", "QTimer"),
        ("work/order_thread.py", "Thread"),
        ("work/background.py", "ThreadPoolExecutor"),
        ("screens/records.py", "QTimer"),
        ("screens/queue_runner.py", "QTimer"),
        ("screens/run_view.py", "QTimer"),
        ("widgets/notice.py", "QTimer"),
        ("widgets/waiting_page.py", "QTimer"),
        ("widgets/scan_field.py", "QTimer"),
        ("widgets/table.py", "QTimer"),
        ("plots/crosshair.py", "QTimer"),
        ("painted.py", "QTimer"),
        ("start.py", "QTimer"),
    }
