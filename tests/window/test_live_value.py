"""The screen Stand shows what a meter reads, while somebody looks at it."""

import math
from threading import Event
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt

from tumble.app.stand import load_stand
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.protocols import ChannelBlock, SampleBlock
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.drivers.simulated.head import SimulatedHead
from tumble.window.widgets.instrument_cards import InstrumentCards
from tumble.window.widgets.live_value import LiveValue, Sparkline, _pieces, _places


def block(*voltages_v):
    return SampleBlock(voltage_v=np.array(voltages_v), rate_hz=100.0, device_time_s=0.0, temperature_degc=None)


@pytest.fixture
def driver(lent_driver):
    lent_driver.window.open(lent_driver.window.stand)
    lent_driver.window.stand.connect_button.click()
    lent_driver.wait(lent_driver.window.stand.disconnect_button.isEnabled)
    return lent_driver


def live(driver):
    return driver.window.stand.cards.live["daq"]


def test_the_newest_value_is_told_with_its_unit(qtbot, qapp):
    shown = LiveValue()
    qtbot.addWidget(shown)
    shown.see(block(2.5, 2.6))
    assert shown.said.text() == "2.550000 V"


@pytest.mark.parametrize(
    ("voltages_v", "said"), [((1.0, -9.9e37), "overload"), ((9.9e37,), "overload"), ((1.0, np.nan), "no value")]
)
def test_what_is_no_value_is_said_and_leaves_a_gap(qtbot, qapp, voltages_v, said):
    shown = LiveValue()
    qtbot.addWidget(shown)
    shown.see(block(*voltages_v))
    assert shown.said.text() == said
    assert not np.isfinite(shown.line.values[-1])


def test_an_overload_is_said_of_the_channel_that_has_it(qtbot, qapp):
    shown = LiveValue()
    qtbot.addWidget(shown)
    channels = {"u_x_v": np.array([9.9e37]), "u_y_v": np.array([1.5])}
    shown.see(ChannelBlock(channels=channels, rate_hz=100.0, device_time_s=0.0, temperature_degc=None))
    assert shown.said.text() == "u_x_v: overload\nu_y_v: 1.5"


def test_a_meter_that_gives_nothing_has_no_value_and_one_gap(qtbot, qapp):
    shown = LiveValue()
    qtbot.addWidget(shown)
    shown.see(block(2.5))
    shown.see(None)
    shown.see(None)
    assert shown.said.text() == "no value"
    assert [np.isfinite(value) for value in shown.line.values] == [True, False]


def test_a_stand_with_the_same_names_has_its_own_samplers(qtbot, qapp):
    instruments = load_stand().file.instruments
    cards = InstrumentCards()
    qtbot.addWidget(cards)
    for samplers in (["daq"], ["head"]):
        file = SimpleNamespace(
            instruments=instruments, samplers={name: instruments[name] for name in samplers}, environments={}
        )
        cards.show_stand(SimpleNamespace(file=file))
        assert list(cards.live) == samplers


def test_a_line_goes_from_the_lowest_value_at_the_bottom_to_the_highest_on_top():
    first, second, third = _places(np.array([1.0, 3.0, 2.0]), 100.0, 42.0)
    assert (first.y(), second.y(), third.y()) == (40.0, 2.0, 21.0)
    assert first.x() < second.x() < third.x() == 98.0


def test_what_is_no_number_is_left_out():
    assert len(_places(np.array([1.0, np.nan, 2.0]), 100.0, 42.0)) == 2


def test_a_line_is_broken_at_a_gap():
    pieces = _pieces(np.array([1.0, 2.0, np.nan, 3.0, np.inf, np.nan, 4.0, 5.0]), 100.0, 42.0)
    assert [len(piece) for piece in pieces] == [2, 1, 2]
    assert _pieces(np.array([np.nan]), 100.0, 42.0) == []


def test_a_value_between_two_gaps_is_a_dot(qtbot, qapp):
    line = Sparkline()
    qtbot.addWidget(line)
    line.resize(100, 42)
    line.add(1.0)
    for value in (math.nan, 2.0, math.nan, 1.0):
        line.add(value)
    picture = line.grab().toImage()
    ground = picture.pixelColor(0, 0)
    place = _places(np.array(line.values), 100.0, 42.0)[1]
    inked = [(x, y) for x in range(picture.width()) for y in range(12) if picture.pixelColor(x, y) != ground]
    assert inked
    assert all(abs(x - place.x()) < 3 and abs(y - place.y()) < 3 for x, y in inked)


def test_a_value_that_stays_is_drawn_at_half_the_height():
    assert [place.y() for place in _places(np.array([1.0, 1.0]), 100.0, 42.0)] == [21.0, 21.0]


def test_a_line_keeps_half_a_minute(qtbot, qapp):
    line = Sparkline()
    qtbot.addWidget(line)
    for value in range(200):
        line.add(float(value))
    assert (len(line.values), line.values[0]) == (150, 50.0)


def test_a_stand_that_is_watched_is_read_again_and_again(driver):
    driver.wait(lambda: len(live(driver).line.values) >= 3)
    assert live(driver).said.text().endswith(" V")
    assert live(driver).line.isVisible()


def test_nothing_is_read_behind_another_screen(driver):
    driver.wait(lambda: live(driver).line.values)
    driver.window.open(driver.window.records)
    seen = []
    driver.window.worker.position_seen.connect(lambda *_: seen.append(len(live(driver).line.values)))
    driver.wait(lambda: len(seen) >= 4)
    assert len(set(seen)) == 1  # not even what the look that was under way saw
    assert live(driver).said.text() == "—"


def test_a_line_goes_on_after_a_gap_where_somebody_looked_away(driver):
    driver.wait(lambda: live(driver).line.values)
    driver.window.open(driver.window.records)
    read = len(live(driver).line.values)
    driver.window.open(driver.window.stand)
    driver.wait(lambda: len(live(driver).line.values) > read)
    finite = np.isfinite(live(driver).line.values)
    assert (finite[read - 2], finite[read - 1], finite[read]) == (True, False, True)


def test_no_reading_stays_on_screen_while_an_order_is_carried_out(driver):
    driver.wait(lambda: live(driver).line.values)
    said = []
    driver.window.worker.working.connect(lambda working: said.append((working, live(driver).said.text())))
    driver.window.worker.move_by("head", 1.0)
    driver.wait(lambda: (False, "—") in said)
    assert said[0] == (True, "—")
    assert np.isnan(live(driver).line.values).any()


def test_what_a_stand_read_is_forgotten_with_it(driver):
    driver.wait(lambda: live(driver).line.values)
    driver.window.stand.disconnect_button.click()
    driver.wait(lambda: not driver.window.stand.disconnect_button.isEnabled())
    assert live(driver).said.text() == "—"
    assert not live(driver).line.values


def test_an_answer_that_is_none_leaves_the_stand_connected(driver, monkeypatch):
    asked = []

    def refuse(*_):
        asked.append(True)
        raise DeviceError("voltmeter", "answers something else", "look at it")

    monkeypatch.setattr(SimulatedDaq, "acquire", refuse)
    driver.wait(lambda: len(asked) >= 2 and live(driver).said.text() == "no value")
    assert driver.complaints == []
    assert driver.window.worker.session.is_connected


def test_a_meter_that_falls_silent_keeps_no_value_on_screen(driver, monkeypatch):
    driver.wait(lambda: live(driver).said.text().endswith(" V"))

    def keep_silent(*_):
        raise NoReplyError("voltmeter", "does not answer", "look at it")

    monkeypatch.setattr(SimulatedDaq, "acquire", keep_silent)
    driver.wait(lambda: live(driver).said.text() == "no value")
    assert driver.complaints == []


def test_a_meter_that_is_gone_is_told(driver, monkeypatch):
    def vanish(*_):
        raise LinkLostError("voltmeter", "is gone", "check its cable")

    monkeypatch.setattr(SimulatedDaq, "acquire", vanish)
    driver.wait(lambda: driver.complaints)
    assert driver.complaints == ["voltmeter: is gone; check its cable"]


def test_stop_does_not_wait_for_a_meter_that_is_silent(driver, monkeypatch):
    attention, told, waiting = driver.window.worker.session.connected.stand.attention, Event(), Event()
    stop = SimulatedHead.stop

    def keep_silent(*_):
        waiting.set()
        while not told.wait(0.01):
            attention.check()
        raise NoReplyError("voltmeter", "does not answer", "look at it")

    monkeypatch.setattr(SimulatedDaq, "acquire", keep_silent)
    monkeypatch.setattr(SimulatedHead, "stop", lambda head: (told.set(), stop(head)))
    driver.wait(waiting.is_set)
    driver.press(Qt.Key.Key_F12)
    driver.wait(told.is_set, timeout_s=10)
    assert driver.complaints == []
