from datetime import UTC, datetime, timedelta

import pytest
from PySide6.QtCore import QSettings, Qt
from PySide6.QtWidgets import QWidget
from window_driver import STAND

from tumble.drivers.protocols import PositionerStatus
from tumble.window.look.shades import DARK, LIGHT
from tumble.window.look.theme import colours


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def connect(driver):
    stand = driver.window.stand
    driver.window.open(stand)
    stand.connect_button.click()
    driver.wait(stand.jog.isEnabled)
    return stand


def test_a_stand_says_who_it_is(driver):
    stand = connect(driver)
    assert stand.cards.cards["head"].text("model") == "tumble simulated head"
    assert stand.cards.cards["daq"].text("serial") == "SIM-DAQ"
    assert stand.cards.cards["head"].link.text() == "connected"
    stand.disconnect_button.click()
    driver.wait(lambda: stand.cards.cards["head"].text("model") == "—")


def test_the_head_goes_where_it_is_told(driver):
    stand = connect(driver)
    driver.type("12 30", stand.jog.angle)
    driver.press(Qt.Key.Key_F8)
    driver.wait(lambda: stand.dials.of("head").accessibleName() == "12.5000°")
    stand.jog.step.setCurrentIndex(stand.jog.step.findText("10°"))
    driver.press(Qt.Key.Key_Right, Qt.KeyboardModifier.ControlModifier)
    driver.wait(lambda: stand.dials.of("head").accessibleName() == "22.5000°")
    driver.press(Qt.Key.Key_Home, Qt.KeyboardModifier.ControlModifier)
    driver.wait(lambda: stand.dials.of("head").accessibleName() == "0.0000°")


def test_enter_in_the_field_of_the_angle_moves_nothing(driver):
    stand = connect(driver)
    driver.scan("45", at=stand.jog.angle)
    driver.bot.wait(300)
    assert stand.dials.of("head").accessibleName() == "0.0000°"


def test_an_angle_outside_the_limits_is_refused(driver):
    stand = connect(driver)
    stand.jog.angle.setText("800")
    driver.press(Qt.Key.Key_F8)
    driver.wait(lambda: bool(driver.complaints))
    assert "800" in driver.complaints[0]


def test_what_is_no_angle_is_told(driver):
    stand = connect(driver)
    stand.jog.angle.setText("half a turn")
    driver.press(Qt.Key.Key_F8)
    driver.wait(lambda: bool(driver.complaints))
    assert "'half a turn' is no angle" in driver.complaints[0]


def test_certificates_are_shown_with_what_is_due(driver, write):
    today = datetime.now(tz=UTC).date()
    dated = STAND.replace("[daq]\n", f'[daq]\ncertificate = "C-17"\ncalibration_due = {today + timedelta(days=7)}\n')
    dated = dated.replace("[head]\n", f"[head]\ncalibration_due = {today - timedelta(days=1)}\n")
    driver.window.stand.open(write("dated.toml", dated))
    head, daq = (driver.window.stand.cards.cards[name] for name in ("head", "daq"))
    assert daq.text("certificate") == "C-17"
    assert head.calibration.text().startswith("Calibration overdue since ")
    assert daq.calibration.text().startswith("Calibration soon due: ")


def test_home_it_first_is_said_until_the_head_knows_its_angle(driver):
    seen, stand = driver.window.worker.position_seen, driver.window.stand
    seen.emit("head", PositionerStatus(angle_deg=0.0, moving=False, device_time_s=0.0, referenced=False))
    assert stand._notice.text() == "The head does not know its angle: home it first."
    seen.emit("head", PositionerStatus(angle_deg=0.0, moving=False, device_time_s=0.0))
    assert stand._notice.text() == ""


def test_programmes_that_the_loop_asks_for_come_last(driver):
    box = driver.window.run.form.programme
    names = [name for place in range(box.count()) if "/" not in (name := box.itemText(place))]
    probes = [name.startswith("probe-") for name in names]
    assert probes == sorted(probes)
    assert True in probes


def test_a_head_that_is_turned_by_hand_cannot_be_jogged(driver, write):
    manual = STAND.replace('driver = "simulated"\nlimits', 'driver = "manual"\nserial = "OG-7"\nlimits')
    stand = driver.window.stand
    stand.open(write("manual.toml", manual))
    driver.window.open(stand)
    stand.connect_button.click()
    driver.wait(lambda: stand.cards.cards["head"].text("serial") == "OG-7")
    driver.wait(stand.disconnect_button.isEnabled)
    assert not stand.jog.isEnabled()


def test_settings_are_remembered(driver, write):
    driver.window.stand.open(write("bench.toml", STAND))
    driver.window.run.form.add_programme("reversal")
    driver.window.open(driver.run)
    driver.window.resize(790, 701)
    driver.running._restart()
    assert driver.window.stand.loaded.file.name == "bench-1"
    assert driver.window.run.form.programme.currentText() == "reversal"
    assert driver.run.isVisible()
    assert driver.window.height() == 701


def test_colours_that_are_chosen_anew_reach_everything_at_once(driver):
    try:
        QSettings().setValue("look/shade", "dark")
        driver.window.dress_wanted.emit()
        assert f"QFrame#card {{ background: {DARK.paper};" in driver.window.styleSheet()
        assert {colours(part) for part in driver.window.findChildren(QWidget)} == {DARK}
    finally:
        QSettings().setValue("look/shade", "light")
        driver.window.dress_wanted.emit()
    assert f"QFrame#card {{ background: {LIGHT.paper};" in driver.window.styleSheet()
