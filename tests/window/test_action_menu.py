"""What can be done with a row is offered by the right button and the key Menu, and is what buttons and keys do."""

from datetime import UTC, datetime

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent, QGuiApplication
from PySide6.QtWidgets import QApplication, QMenu

from tumble.app.cut_off import CutOff
from tumble.app.stand import load_stand
from tumble.window.screens.cut_off_view import CutOffView
from tumble.window.screens.records import RecordsScreen
from tumble.window.widgets.action_menu import ActionButton
from tumble.window.widgets.instrument_cards import InstrumentCards
from tumble.window.widgets.queue_view import QueueView
from tumble.window.widgets.table import Table
from tumble.window.work.background import Background
from tumble.window.work.run_queue import Entry

MOUSE, KEY = QContextMenuEvent.Reason.Mouse, QContextMenuEvent.Reason.Keyboard


@pytest.fixture
def shown(qtbot):
    def show(part):
        qtbot.addWidget(part)
        part.resize(600, 300)
        part.show()
        part.activateWindow()
        qtbot.waitUntil(part.isActiveWindow)
        return part

    return show


def ask(part, reason):
    place = QPoint(5, 5)
    QApplication.sendEvent(part, QContextMenuEvent(reason, place, part.mapToGlobal(place)))


def menu():
    opened = QApplication.activePopupWidget()
    assert isinstance(opened, QMenu)
    return opened


def lines():
    return [line.text().replace("&", "") for line in menu().actions()]


def choose(title):
    (line,) = [line for line in menu().actions() if line.text().replace("&", "") == title]
    line.trigger()
    menu().close()


@pytest.fixture
def table(shown):
    table = shown(Table(["unit", "state"]))
    table.fill([("A-1", "waits"), ("B-2", "is done")])
    return table


@pytest.mark.parametrize("reason", [MOUSE, KEY])
def test_a_row_is_copied_from_the_menu(table, reason):
    table.selectRow(1)
    ask(table.viewport() if reason is MOUSE else table, reason)
    choose("Copy rows")
    assert QGuiApplication.clipboard().text() == "B-2\tis done"


def test_rows_are_copied_only_where_one_is_chosen(table):
    (copying,) = [line for line in table.actions() if line.text() == "Copy rows"]
    assert not copying.isEnabled()
    table.selectRow(0)
    assert copying.isEnabled()
    table.clearSelection()
    assert not copying.isEnabled()
    table.selectRow(0)
    table.fill([])
    assert not copying.isEnabled()


def test_the_right_button_chooses_the_row_that_it_is_pressed_on(qtbot, table):
    place = table.visualItemRect(table.cell(1, 0)).center()
    qtbot.mouseClick(table.viewport(), Qt.MouseButton.RightButton, pos=place)
    assert table.chosen == [1]


def test_the_menu_says_the_key_of_what_it_offers(table):
    table.offer("Take it out", lambda: None, "Del")
    ask(table, KEY)
    assert [line.shortcut().toString() for line in menu().actions()] == ["Del", "Ctrl+C"]
    menu().close()


def test_button_line_and_key_do_the_same(qtbot, table):
    done = []
    button = ActionButton(table.offer("&Take it out", lambda: done.append("out"), "Del"))
    qtbot.addWidget(button)
    button.click()
    ask(table, KEY)
    choose("Take it out")
    table.setFocus()
    qtbot.keyClick(table, Qt.Key.Key_Delete)
    assert (button.text(), done) == ("&Take it out", ["out"] * 3)


def test_what_cannot_be_done_is_grey_in_both(qtbot, table):
    button = ActionButton(table.offer("Take it out", lambda: None))
    qtbot.addWidget(button)
    button.action.setEnabled(False)
    table.selectRow(0)
    ask(table, KEY)
    assert not button.isEnabled()
    assert [line.isEnabled() for line in menu().actions()] == [False, True]
    menu().close()


def test_the_queue_offers_what_its_buttons_do(shown):
    queue = shown(QueueView())
    queue.show_entries([Entry(serial_number="SN-1", programme="seed", operator="Ann", stand="", id="1")])
    queue.table.selectRow(0)
    taken_out = []
    queue.remove_wanted.connect(taken_out.append)
    ask(queue.table, KEY)
    assert lines() == ["Open the record", "Up", "Down", "Remove", "Clear", "Copy rows"]
    assert [line.isEnabled() for line in menu().actions()] == [False, True, True, True, True, True]
    choose("Remove")
    assert taken_out == ["1"]


def test_a_run_without_a_record_is_analysed_or_discarded_from_the_menu_and_not_gone_on_with(shown, cut_off):
    view = shown(CutOffView())
    view.show_runs((cut_off,), {})
    wanted = []
    view.discard_wanted.connect(wanted.append)
    ask(view.table, KEY)
    assert lines() == ["Analyse as it is", "Discard…", "Copy rows"]
    choose("Discard…")
    assert wanted == [cut_off.path]


@pytest.fixture
def cut_off(tmp_path):
    return CutOff(
        path=tmp_path / "stopped.mcap",
        method="dividing_head",
        serial_number="SN-1",
        programme_name="seed",
        points=3,
        ending="",
        stand_name="bench-1",
        began_at=datetime(2026, 1, 1, tzinfo=UTC),
    )


def enabled(table):
    return [action.isEnabled() for action in table.actions()[:-1]]


def test_while_the_store_is_read_there_is_nothing_to_do_with_a_record(qtbot, settings, tmp_path):
    background = Background()
    screen = RecordsScreen(background, lambda: tmp_path)
    qtbot.addWidget(screen)
    for reading in (background, screen.surveyor):
        reading.leave()
    assert enabled(screen.table) == [False] * 5
    assert enabled(screen.cut_off.table) == [False] * 2
    assert not screen.cut_off.resume_button.isEnabled()


def test_a_card_of_an_instrument_is_copied_from_its_menu(shown):
    cards = shown(InstrumentCards())
    cards.show_stand(load_stand())
    ask(cards.cards["head"], KEY)
    choose("Copy")
    assert QGuiApplication.clipboard().text().splitlines()[:2] == ["Dividing head", "not connected"]


def test_a_card_offers_what_can_be_done_with_its_stand(driver):
    driver.window.open(driver.window.stand)
    ask(driver.window.stand.cards.cards["head"], KEY)
    assert lines() == ["Copy", "Connect", "Disconnect", "Edit…"]
    choose("Connect")
    driver.wait(lambda: driver.window.worker.session.is_connected)
