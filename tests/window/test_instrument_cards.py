"""The cards of a stand's instruments."""

from datetime import date
from itertools import combinations

import pytest
from PySide6.QtCore import QPoint, QSize, Qt
from PySide6.QtGui import QGuiApplication
from window_driver import STAND

from benchmarks.endurance.two_axes import SIMULATED, SIMULATED_CHAMBER, WORLD
from tumble.app.stand import load_stand
from tumble.drivers.errors import DeviceError, NoReplyError
from tumble.drivers.protocols import Identity
from tumble.drivers.simulated.chamber import SimulatedChamber
from tumble.drivers.simulated.head import SimulatedHead
from tumble.drivers.tables import Instrument
from tumble.window.widgets.instrument_card import calibration
from tumble.window.widgets.instrument_cards import InstrumentCards
from tumble.window.widgets.lamp import Lamp, Light

HEAD = Identity(model="NSC-A", serial="7", firmware="1.2")


@pytest.fixture
def cards(qtbot, qapp):
    shown = InstrumentCards()
    qtbot.addWidget(shown)
    shown.show_stand(load_stand())
    return shown


def lamps(card):
    return card.link.lamp.light, card.calibration.lamp.light


@pytest.mark.parametrize(
    ("due", "light", "said"),
    [
        (None, Light.UNKNOWN, "Calibration: no due date stated"),
        (date(2026, 3, 9), Light.BAD, "Calibration overdue since "),
        (date(2026, 3, 10), Light.SOON, "Calibration soon due: "),
        (date(2026, 4, 8), Light.SOON, "Calibration soon due: "),
        (date(2026, 4, 9), Light.GOOD, "Calibration valid until "),
    ],
)
def test_a_calibration_holds_to_its_due_date_and_is_soon_due_for_thirty_days(qapp, due, light, said):
    table = Instrument(driver="simulated", calibration_due=due)
    told, text = calibration(table, date(2026, 3, 10))
    assert (told, text.startswith(said)) == (light, True)


def test_a_lamp_has_a_shape_of_its_own_for_everything_it_says(qtbot, qapp):
    lamp, drawn = Lamp(), {}
    qtbot.addWidget(lamp)
    lamp.resize(40, 40)
    for light in Light:
        lamp.show_light(light)
        picture = lamp.grab().toImage()
        ground = picture.pixel(0, 0)
        drawn[light] = {(x, y) for x in range(40) for y in range(40) if picture.pixel(x, y) != ground}
    assert all(len(one ^ other) > 100 for one, other in combinations(drawn.values(), 2))


def test_a_stand_that_nobody_asked_is_not_connected(cards):
    assert {lamps(card) for card in cards.cards.values()} == {(Light.UNKNOWN, Light.UNKNOWN)}
    assert cards.cards["head"].link.text() == "not connected"


def test_who_answers_is_connected(cards):
    cards.show_identity("head", HEAD)
    assert cards.cards["head"].link.text() == "connected"
    assert cards.cards["daq"].link.text() == "not connected"
    cards.forget_identities()
    assert cards.cards["head"].link.text() == "not connected"


def test_what_failed_says_so_until_that_is_forgotten(cards):
    cards.show_identity("head", HEAD)
    cards.show_fault("head")
    assert lamps(cards.cards["head"])[0] is Light.BAD
    assert lamps(cards.cards["daq"])[0] is Light.UNKNOWN
    cards.forget_faults()
    assert lamps(cards.cards["head"])[0] is Light.GOOD


def test_cards_stand_beside_each_other_where_they_have_room(cards):
    cards.show()
    widest = cards.minimumSizeHint().width()
    head, daq = cards.cards.values()
    cards.resize(QSize(3 * widest, 400))
    cards.layout().activate()
    assert (head.y(), head.x() < daq.x()) == (daq.y(), True)
    cards.resize(QSize(widest, 800))
    cards.layout().activate()
    assert (head.x(), head.y() < daq.y()) == (daq.x(), True)


def test_a_card_is_reached_by_tab_and_copied_as_text(cards, qtbot):
    cards.show_identity("head", HEAD)
    head = cards.cards["head"]
    assert head.focusPolicy() & Qt.FocusPolicy.TabFocus
    cards.show()
    cards.activateWindow()
    qtbot.waitUntil(cards.isActiveWindow)
    head.setFocus()
    qtbot.keyClick(head, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text().splitlines()[:5] == [
        "Dividing head",
        "connected",
        "Calibration: no due date stated",
        "Model: NSC-A",
        "Serial number: 7",
    ]
    assert head.accessibleName() == "Dividing head, connected, Calibration: no due date stated"


def test_cards_of_another_stand_take_the_place_of_those_before(cards, write):
    before = cards.cards["head"]
    cards.show_stand(load_stand(write("bench.toml", STAND)))
    assert cards.cards["head"] is before
    cards.show_stand(load_stand(None, "triad"))
    assert "head" not in cards.cards
    assert before.isHidden()


@pytest.fixture
def stand(lent_driver):
    """The screen, connected."""
    screen = lent_driver.window.stand
    lent_driver.window.open(screen)
    screen.connect_button.click()
    lent_driver.wait(screen.jog.isEnabled)
    return screen


@pytest.fixture
def stuck(monkeypatch):
    """Heads cannot be moved; their driver calls them otherwise than the stand does."""

    def refuse(*_):
        raise DeviceError("Zaber head (device 1, axis 1)", "is stuck", "look at it")

    monkeypatch.setattr(SimulatedHead, "start_move", refuse)


def test_a_fault_is_seen_on_the_card_until_something_else_is_begun(lent_driver, stand, stuck, monkeypatch):
    head = stand.cards.cards["head"]
    lent_driver.window.worker.move_by("head", 1.0)
    lent_driver.wait(lambda: head.link.text() == "fault")
    assert stand.cards.cards["daq"].link.text() == "connected"
    monkeypatch.undo()
    lent_driver.window.worker.move_by("head", 1.0)
    assert head.link.text() == "connected"


def test_so_is_the_one_that_has_broken_a_run_off(lent_driver, stand, stuck, long):
    lent_driver.start(long)
    lent_driver.wait_for_end()
    assert {name: card.link.text() for name, card in stand.cards.cards.items()} == {"head": "fault", "daq": "connected"}


def test_a_move_that_is_refused_is_no_fault_of_the_head(lent_driver, stand):
    lent_driver.window.worker.move_to("head", 1e6)
    lent_driver.wait(lambda: lent_driver.complaints != [])
    assert stand.cards.cards["head"].link.text() == "connected"


def test_no_card_lies_upon_another(lent_driver, stand):
    for width in (1264, 1900):
        lent_driver.window.resize(width, 760)
        lent_driver.bot.wait(50)
        head, daq = (stand.cards.cards[name] for name in ("head", "daq"))
        shown = [card.rect().translated(card.mapTo(stand, QPoint())) for card in (head, daq)]
        assert not shown[0].intersects(shown[1])
        assert all(card.height() >= card.minimumSizeHint().height() for card in (head, daq))


def test_cards_fold_where_one_of_them_says_something_longer(cards, qtbot):
    cards.show()
    head, daq = cards.cards.values()
    cards.resize(QSize(2 * cards.minimumSizeHint().width() + 10, 600))
    qtbot.waitUntil(lambda: head.y() == daq.y())
    cards.show_identity("daq", Identity(model="a voltmeter with a name that is very long", serial="7"))
    qtbot.waitUntil(lambda: head.y() < daq.y())


WITH_CHAMBER = f'name = "oven"\n{SIMULATED}\n{SIMULATED_CHAMBER}\n{WORLD}'


@pytest.fixture
def oven(lent_driver, write):
    """The card of a temperature chamber that is connected."""
    screen = lent_driver.window.stand
    screen.open(write("oven.toml", WITH_CHAMBER))
    lent_driver.window.open(screen)
    screen.connect_button.click()
    lent_driver.wait(screen.disconnect_button.isEnabled)
    return screen.cards.cards["chamber"]


def test_a_chamber_shows_the_temperature_of_its_air(lent_driver, oven):
    lent_driver.wait(lambda: oven.live.said.text().endswith(" °C"))
    assert oven.live.line.isVisible()
    assert lent_driver.complaints == []


def test_a_chamber_that_falls_silent_shows_none_and_leaves_the_stand_connected(lent_driver, oven, monkeypatch):
    asked = []

    def keep_silent(_):
        asked.append(True)
        raise NoReplyError("temperature chamber", "does not answer", "look at it")

    monkeypatch.setattr(SimulatedChamber, "status", keep_silent)
    lent_driver.wait(lambda: oven.live.said.text() == "no value")
    lent_driver.bot.wait(500)
    assert len(asked) == 1
    assert lent_driver.window.worker.session.is_connected
