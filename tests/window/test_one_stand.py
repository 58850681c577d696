"""What is shown is what is connected: stand file, identities, dial and the head that moves are one object."""

import ast
from types import SimpleNamespace

import pytest
from dialogs_of_the_window import ROOT
from PySide6.QtCore import Qt
from window_driver import STAND

from tumble.app.stand import load_stand
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import PositionerStatus
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.procedures.errors import InputError
from tumble.procedures.events import Identified
from tumble.procedures.programmes import load_programme
from tumble.window.widgets.dialog import QuestionDialog


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


@pytest.fixture
def stands(write):
    """Files of two stands."""
    return write("a.toml", STAND.replace("bench-1", "A")), write("b.toml", STAND.replace("bench-1", "B"))


@pytest.fixture
def cut_off_at_b(driver, stands, tiny, tmp_path, monkeypatch):
    """A run of stand B that a fault has ended, with stand A on screen since."""
    acquire, calls = SimulatedDaq.acquire, []

    def failing(*arguments):
        calls.append(arguments)
        if len(calls) == 3 * 2 + 2:
            raise DeviceError("voltmeter", "does not answer", "check its cable, then resume the run")
        return acquire(*arguments)

    a, b = stands
    driver.window.stand.open(b)
    monkeypatch.setattr(SimulatedDaq, "acquire", failing)
    driver.start(tiny)
    driver.wait_for_end()
    monkeypatch.undo()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    driver.dismiss_all()
    driver.window.stand.open(a)
    driver.wait(lambda: not driver.window.busy)
    (path,) = (tmp_path / "store").glob("recordings/SN-1/*.mcap")
    return path


def shown(driver):
    """Every place where the window names or uses a stand."""
    window = driver.window
    return {
        window.windowTitle().split(" – ")[0],
        window.stand.loaded.file.name,
        window.stand._name.text().split("</b>")[0].removeprefix("<b>"),
        window.worker.session.loaded.file.name,
        window.run.form._stand().file.name,
        window.result._stand().file.name,
    }


def test_a_run_of_another_stand_asks_and_brings_its_stand_on_screen(driver, cut_off_at_b, no_report):
    driver.window.records.resume(cut_off_at_b)
    driver.wait(lambda: driver.window.dialogs.open)
    (question,) = driver.window.dialogs.open
    assert isinstance(question, QuestionDialog)
    assert "measured at the stand B" in question.text()
    assert "on screen is the stand A" in question.text()
    assert shown(driver) == {"A"}
    driver.press(Qt.Key.Key_F3)
    driver.wait(lambda: shown(driver) == {"B"})
    driver.wait_for_result()
    assert shown(driver) == {"B"}
    assert driver.window.worker.session.connected.stand.name == "B"


def test_declined_it_moves_nothing_and_changes_nothing(driver, cut_off_at_b):
    driver.window.records.resume(cut_off_at_b)
    driver.wait(lambda: driver.window.dialogs.open)
    driver.press(Qt.Key.Key_Escape)
    assert driver.window.dialogs.open == []
    assert shown(driver) == {"A"}
    assert not driver.window.busy
    assert not driver.window.worker.session.is_connected


def test_no_order_reaches_another_stand_than_the_one_on_screen(driver, stands, tiny):
    a, b = stands
    driver.window.stand.open(a)
    job = SimpleNamespace(stand=load_stand(b), programme=load_programme(tiny))
    with pytest.raises(InputError, match="belongs to the stand B, and A is chosen"):
        driver.window.worker.begin(SimpleNamespace(job=job), driver.window.stand.attendant())


def test_an_experiment_for_a_unit_of_another_stand_is_refused(driver, stands):
    a, b = stands
    driver.window.stand.open(a)
    origin = SimpleNamespace(serial_number="SN-1", stand=load_stand(b).recorded, stand_name="B")
    traced = SimpleNamespace(provenance=origin)
    driver.window.result.presentation = SimpleNamespace(concluded=SimpleNamespace(traced=traced))
    driver.window.result._run_experiment("probe-face-up-90")
    (told,) = driver.complaints
    assert told.startswith("SN-1 was measured at the stand B, and the stand A is on screen")
    assert not driver.window.busy
    driver.window.result.presentation = None


def test_no_other_stand_is_chosen_while_one_is_at_work(driver, stands, long):
    a, b = stands
    stand = driver.window.stand
    stand.open(a)
    stand.simulation.speed.setCurrentIndex(2)
    driver.start(long)
    assert not any(button.isEnabled() for button in (stand._browse, stand._built_in, stand.simulation))
    stand.open(b)
    assert driver.complaints == ["The stand is at work: stop it, or wait, before you choose another"]
    assert shown(driver) == {"A"}


def test_nothing_that_moves_waits_behind_a_run(driver, long):
    worker = driver.window.worker
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    driver.start(long)
    for move in (
        lambda: worker.move_to("head", 700.0),
        lambda: worker.move_by("head", 90.0),
        lambda: worker.home("head"),
    ):
        move()
    driver.wait_for_points(1)
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    head = worker.session.connected.stand.positioners["head"]
    here_deg = head.status().angle_deg
    driver.bot.wait(300)
    assert head.status().angle_deg == here_deg < 90.0


def test_what_is_told_of_a_stand_that_was_left_is_not_shown(driver, stands):
    a, b = stands
    driver.window.stand.open(a)
    worker, left = driver.window.worker, driver.window.worker.session
    driver.window.stand.open(b)
    worker._tell(left, worker.position_seen, "head", PositionerStatus(angle_deg=123.0, moving=True, device_time_s=0.0))
    driver.bot.wait(50)
    assert driver.window.stand.dials.of("head").accessibleName() == ""
    assert driver.run.view.dials.of("head").accessibleName() == ""


def test_a_stand_that_was_chosen_is_not_connected_though_the_one_before_was(driver, stands):
    a, _ = stands
    stand = driver.window.stand
    stand.connect_button.click()
    driver.wait(stand.jog.isEnabled)
    stand.open(a)
    assert stand.connect_button.isEnabled()
    assert not stand.disconnect_button.isEnabled()
    assert not stand.jog.isEnabled()
    assert driver.window.stop_bar._angle.text() == "not connected"


def test_an_instrument_that_names_itself_anew_in_a_run_is_shown(driver):
    driver.window.stand.connect_button.click()
    driver.wait(driver.window.stand.jog.isEnabled)
    driver.window.bridge.listen(Identified(instrument="daq", model="34465A", serial="MY2", firmware="3"))
    driver.wait(lambda: driver.window.stand.cards.cards["daq"].text("serial") == "MY2")


def test_a_stand_that_cannot_be_read_any_more_is_told_at_the_start(driver, stands):
    a, _ = stands
    driver.window.stand.open(a)
    a.unlink()
    before = driver.window
    driver.running._restart()
    driver.wait(lambda: driver.window is not before)
    assert "a.toml" in driver.complaints[0]
    assert shown(driver) == {"simulated"}


def test_names_are_text_and_no_markup(driver, write):
    driver.window.stand.open(write("odd.toml", STAND.replace("bench-1", "<b>x</b>")))
    assert "&lt;b&gt;x" in driver.window.stand._name.text()


def test_instruments_are_reached_in_one_place():
    """Who else connects, or makes a session, makes a second head that the screen does not show."""
    found = {
        (path.relative_to(ROOT).as_posix(), node.func.id)
        for path in ROOT.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id in ("connect", "StandSession", "StandWorker")
    }
    assert found == {
        ("work/session.py", "connect"),
        ("work/stand_worker.py", "StandSession"),
        ("main_window.py", "StandWorker"),
    }
